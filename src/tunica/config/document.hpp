// A case file as a tree of keys, before any of them has a meaning: parts of it move to other files, and what it settles
// can be listed key by key.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tunica/config/schema.hpp"

namespace YAML {
class Node;
}

namespace tunica::config {

/// Paths name keys from the top, as in "wall.material", and entries of lists that are there by their number from 1, as
/// in "families[2].k1". A copy shares nothing with its original.
class Document {
 public:
  Document();
  /// Throws InputError when the text is no YAML, or contains itself, or is too deep or large; `name` is for its
  /// message.
  explicit Document(const std::string& yaml, const std::string& name = "case file");
  Document(const Document& other);
  Document& operator=(const Document& other);
  ~Document();

  bool has(std::string_view path) const;
  /// The scalar there; empty when there is none.
  std::string text(std::string_view path) const;
  /// What is below a key, empty when there is nothing.
  Document part(std::string_view path) const;

  /// Makes the sections on the way when they are missing. Throws InputError where a value or list stands in the way.
  void set(std::string_view path, const Document& value);
  void set(std::string_view path, const std::string& scalar);
  void remove(std::string_view path);

  const YAML::Node& node() const { return *node_; }

 private:
  std::unique_ptr<YAML::Node> node_;
};

/// One key with a value of its own, in the form that does not depend on how it was written: quantities in SI units,
/// defaults like values that were given.
struct Setting {
  std::string path, value;
  Kind kind = Kind::text;

  bool operator==(const Setting&) const = default;
};

/// As parse() of description.hpp. `settings`: receives what was read, in the order of the description; nullptr: it is
/// not wanted.
std::vector<Problem> parse(const Description& description, void* object, const Document& document, const Origin& origin,
                           std::vector<Setting>* settings = nullptr);

template <class T>
Parsed<T> parse_document(const Schema<T>& schema, const Document& document, const Origin& origin,
                         std::vector<Setting>* settings = nullptr) {
  Parsed<T> parsed;
  parsed.warnings = parse(*schema.description(), &parsed.value, document, origin, settings);
  return parsed;
}

/// Rewrites the names of files and folders, which count from the folder `from`, so that they count from `to`.
void move_paths(Document& document, const Description& description, const std::filesystem::path& from,
                const std::filesystem::path& to);

/// The document as one line of YAML.
std::string one_line(const Document& document);

/// The document as YAML, each section and key with the first sentence of its help as a comment.
std::string commented_yaml(const Document& document, const Description& description);

}  // namespace tunica::config
