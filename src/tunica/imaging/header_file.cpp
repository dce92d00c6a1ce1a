#include "tunica/imaging/header_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"

namespace tunica::imaging {

const std::string* TextHeader::find(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? nullptr : &found->second;
}

const std::string& TextHeader::need(const std::string& name) const {
  if (const auto* value = find(name)) return *value;
  throw InputError(path.string(), "the header has no field '" + name + "'",
                   "write the image again, with all its header");
}

std::vector<double> TextHeader::numbers(const std::string& name, std::size_t count) const {
  std::string text = need(name);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::vector<double> result;
  for (const auto& word : words(text)) {
    char* end = nullptr;
    result.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0') result.resize(count + 1);
  }
  if (result.size() != count)
    throw InputError(path.string(), fmt::format("field '{}' is '{}', must be {} numbers", name, need(name), count),
                     "write the image again as a single three-dimensional one");
  return result;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw InputError(path.string(), "cannot be read", "check the path");
  std::ostringstream all;
  all << file.rdbuf();
  return std::move(all).str();
}

std::string decompressed(const std::string& bytes, const std::filesystem::path& path) {
  constexpr int zlib_or_gzip = 15 + 32;
  z_stream stream{};
  inflateInit2(&stream, zlib_or_gzip);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string result;
  int state = Z_OK;
  while (state == Z_OK) {
    const auto done = result.size();
    result.resize(done + (std::size_t{1} << 22));
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + done);
    stream.avail_out = static_cast<uInt>(result.size() - done);
    state = inflate(&stream, Z_NO_FLUSH);
    result.resize(result.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END)
    throw InputError(path.string(), "its compressed data are damaged or end too early", "write the image again");
  return result;
}

std::string compressed(const std::string& bytes, bool gzip) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15 + (gzip ? 16 : 0), 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

std::string trimmed(const std::string& text) {
  const char* blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace tunica::imaging
