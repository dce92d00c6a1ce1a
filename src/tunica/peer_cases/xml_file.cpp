// solver.xml, read by expat.
#include <expat.h>
#include <fmt/format.h>

#include <memory>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

namespace fs = std::filesystem;

namespace {

constexpr int most_inclusions = 8;  ///< files in files

Entry read_tree(const std::string& text, const fs::path& path, int inclusions);

/// What expat calls back for, one object for one file.
class TreeBuilder {
 public:
  TreeBuilder(XML_Parser parser, fs::path path, int inclusions)
      : parser_(parser), path_(std::move(path)), name_(path_.filename().string()), inclusions_(inclusions) {}

  void begin(const char* name, const char** attributes) {
    if (stack_.size() > deepest_section) return fail("has more than 32 sections in each other", "correct the nesting");
    if (++count_ > most_entries) return fail("has more than 100 000 keys", "give the input file of one case");
    Entry entry{.key = name, .label = {}, .value = {}, .file = name_, .line = line()};
    for (int i = 0; attributes[i] != nullptr; i += 2)
      if (i == 0)
        entry.label = text::trimmed(attributes[1]);
      else
        return fail(fmt::format("<{}> has a second attribute, {}", name, attributes[i]), "keep one");
    entry.section = attributes[0] != nullptr;
    stack_.push_back(std::move(entry));
  }

  void end() {
    Entry entry = std::move(stack_.back());
    stack_.pop_back();
    entry.value = std::string(without_blanks(entry.value));
    if (!entry.entries.empty()) {
      entry.section = true;
      if (!entry.value.empty())
        return fail(fmt::format("there is text between the keys of <{}>: {}", entry.key, text::printable(entry.value)),
                    "remove it, or close the tag before it");
    }
    if (stack_.empty())
      root_ = std::move(entry);
    else if (entry.key == "Include_xml")
      include(entry);
    else
      stack_.back().entries.push_back(std::move(entry));
  }

  void characters(const char* begin, int size) {
    if (!stack_.empty()) stack_.back().value.append(begin, static_cast<std::size_t>(size));
  }

  Entry take_root() { return std::move(root_); }
  const std::vector<Problem>& problems() const { return problems_; }

  void fail(const std::string& what, const std::string& remedy) {
    problems_.push_back({fmt::format("{}:{}", path_.string(), line()), what, remedy});
    XML_StopParser(parser_, XML_FALSE);
  }

  static std::string_view without_blanks(std::string_view text) {
    constexpr const char* blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

 private:
  int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser_)); }

  /// The keys of the other file stand in the place of the one that names it.
  void include(const Entry& entry) {
    if (inclusions_ >= most_inclusions) return fail("includes a file in a file nine deep", "end the circle of files");
    if (entry.value.empty()) return;  // as if it were not there
    try {
      const fs::path file = path_.parent_path() / entry.value;
      Entry other = read_tree(text::read(file), file, inclusions_ + 1);
      auto& entries = stack_.back().entries;
      std::move(other.entries.begin(), other.entries.end(), std::back_inserter(entries));
    } catch (const InputError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
      XML_StopParser(parser_, XML_FALSE);
    }
  }

  XML_Parser parser_;
  fs::path path_;
  std::string name_;
  int inclusions_;
  std::size_t count_ = 0;
  std::vector<Entry> stack_;
  Entry root_;
  std::vector<Problem> problems_;
};

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

Entry read_tree(const std::string& text, const fs::path& path, int inclusions) {
  const std::unique_ptr<XML_ParserStruct, FreeParser> parser(XML_ParserCreate("UTF-8"));
  if (!parser) throw std::bad_alloc();
  TreeBuilder builder(parser.get(), path, inclusions);
  XML_SetUserData(parser.get(), &builder);
  XML_SetElementHandler(
      parser.get(),
      [](void* data, const XML_Char* name, const XML_Char** attributes) {
        static_cast<TreeBuilder*>(data)->begin(name, attributes);
      },
      [](void* data, const XML_Char*) { static_cast<TreeBuilder*>(data)->end(); });
  XML_SetCharacterDataHandler(parser.get(), [](void* data, const XML_Char* begin, int size) {
    static_cast<TreeBuilder*>(data)->characters(begin, size);
  });
  XML_SetStartDoctypeDeclHandler(parser.get(), [](void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    static_cast<TreeBuilder*>(data)->fail("has a document type declaration", "remove <!DOCTYPE ...>");
  });
  const auto status = XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE);
  if (!builder.problems().empty()) throw InputError(builder.problems());
  if (status != XML_STATUS_OK)
    throw InputError(fmt::format("{}:{}", path.string(), XML_GetCurrentLineNumber(parser.get())),
                     fmt::format("is no XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get()))),
                     "close every tag that is opened, and put attributes in quotes");
  return builder.take_root();
}

}  // namespace

PeerFile read_xml(const std::string& text, const fs::path& path) {
  PeerFile file{path, Dialect::xml, read_tree(text, path, 0)};
  if (file.root.key != "svMultiPhysicsFile" && file.root.key != "svFSIFile")
    throw InputError(
        fmt::format("{}:{}", path.string(), file.root.line),
        fmt::format("the file begins with <{}>, not with <svMultiPhysicsFile>", text::printable(file.root.key)),
        "name a solver.xml of svMultiPhysics");
  return file;
}

}  // namespace tunica::peer_cases
