#include "tunica/config/yaml_guard.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "tunica/base/error.hpp"

namespace tunica::config {

namespace {

constexpr std::size_t largest_text = 16 << 20;  // bytes
constexpr std::size_t deepest = 50;             // sections within each other
constexpr std::size_t most_values = 100'000;    // after every alias is replaced by what it stands for
constexpr std::size_t longest_key = 200;        // bytes

/// Follows the events of the parser, which come before any node is made.
class Guard : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& name) : name_(name) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { value(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string& text) override {
    if (is_key() && text.size() > longest_key)
      refuse(mark, fmt::format("a key of {} bytes, allowed are {}", text.size(), longest_key), "keys are plain words");
    value(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = values_of_.find(anchor);
    if (found == values_of_.end())
      refuse(mark, "an alias (*) stands inside the value that its anchor (&) names, which would contain itself",
             "write the value out instead of the alias");
    add(mark, found->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor, false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor, true);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    bool map;
    YAML::anchor_t anchor;
    std::size_t items, values_before;
  };

  bool is_key() const { return !levels_.empty() && levels_.back().map && levels_.back().items % 2 == 0; }
  void value(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) values_of_[anchor] = 1;
    add(mark, 1);
  }
  void add(const YAML::Mark& mark, std::size_t values) {
    values_ += values;
    if (values_ > most_values)
      refuse(mark, fmt::format("more than {} values, those behind aliases (*) counted", most_values),
             "put long tables into a .csv file");
    if (!levels_.empty()) ++levels_.back().items;
  }
  void open(const YAML::Mark& mark, YAML::anchor_t anchor, bool map) {
    if (levels_.size() >= deepest)
      refuse(mark, fmt::format("sections and lists nested more than {} deep", deepest),
             "check the brackets and the indentation");
    add(mark, 1);
    levels_.push_back({map, anchor, 0, values_ - 1});
  }
  void close() {
    const Level& level = levels_.back();
    if (level.anchor != YAML::NullAnchor) values_of_[level.anchor] = values_ - level.values_before;
    levels_.pop_back();
  }
  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& what, const std::string& remedy) const {
    throw InputError(fmt::format("{}:{}:{}", name_, mark.line + 1, mark.column + 1), what, remedy);
  }

  const std::string& name_;
  std::vector<Level> levels_;
  std::map<YAML::anchor_t, std::size_t> values_of_;  ///< values behind each anchor that is complete
  std::size_t values_ = 0;
};

}  // namespace

void refuse_unreadable_yaml(const std::string& yaml, const std::string& name) {
  if (yaml.size() > largest_text)
    throw InputError(name, fmt::format("has {} bytes, at most {} are read", yaml.size(), largest_text),
                     "give the case file, not a file of data");
  if (const auto at = yaml.find('\0'); at != std::string::npos)
    throw InputError(fmt::format("{}:{}", name, 1 + std::count(yaml.begin(), yaml.begin() + at, '\n')),
                     "holds a zero byte, and so is no text in UTF-8",
                     "save it as text in UTF-8; UTF-16 and binary files are not read");
  std::istringstream stream(yaml);
  YAML::Parser parser(stream);
  Guard guard(name);
  while (parser.HandleNextDocument(guard)) continue;
}

}  // namespace tunica::config
