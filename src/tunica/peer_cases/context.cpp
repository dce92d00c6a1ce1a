#include "tunica/peer_cases/context.hpp"

#include <fmt/format.h>

#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace fs = std::filesystem;

std::optional<double> Context::number(const Entry& section, std::string_view key) const {
  const Entry* entry = section.find(key);
  if (entry == nullptr) return std::nullopt;
  const ReadNumber read = read_number(entry->value, file.dialect);
  return read.error ? std::nullopt : std::optional(read.value);
}

std::vector<double> Context::vector(const Entry& section, std::string_view key) const {
  const Entry* entry = section.find(key);
  return entry == nullptr ? std::vector<double>() : read_vector(entry->value, file.dialect).values;
}

bool Context::flag(const Entry& section, std::string_view key, bool otherwise) const {
  const Entry* entry = section.find(key);
  if (entry == nullptr) return otherwise;
  const ReadFlag read = read_flag(entry->value, file.dialect);
  return read.error ? otherwise : read.value;
}

std::string Context::text(const Entry& section, std::string_view key, const std::string& otherwise) const {
  const Entry* entry = section.find(key);
  return entry == nullptr ? otherwise : entry->value;
}

std::string Context::source(const Entry& section, std::string_view key, const std::string& otherwise) const {
  const Entry* entry = section.find(key);
  return entry == nullptr ? otherwise : entry->where();
}

std::string Context::quantity(const Entry& entry, const char* unit) const {
  // The digits as they stand there, unless Fortran wrote them.
  const bool plain = entry.value.find_first_of("dD+") == std::string::npos;
  const std::string digits = plain ? entry.value : number_text(read_number(entry.value, file.dialect).value);
  return *unit == '\0' ? digits : digits + " " + unit;
}

fs::path Context::located(const Entry& entry) const { return file.path.parent_path() / entry.value; }

std::string Context::path(const Entry& entry) {
  const fs::path there = located(entry);
  std::error_code none;
  if (!fs::exists(there, none)) warnings.push_back(fmt::format("{}: {} is not there", entry.where(), there.string()));
  if (fs::path(entry.value).is_absolute()) return yaml_text(entry.value);
  const fs::path folder = case_folder.empty() ? "." : case_folder;  // which has no absolute path of its own
  const fs::path from_case =
      fs::absolute(there, none).lexically_normal().lexically_proximate(fs::absolute(folder, none).lexically_normal());
  return yaml_text(from_case.generic_string());
}

void Context::add_required(const Entry& section, const char* key, const char* unit, CaseKey& to, const char* name) {
  if (const Entry* entry = section.find(key))
    to.add(name, quantity(*entry, unit), entry->where());
  else
    refuse(section, fmt::format("has no {}", key), "write it: the law needs it");
}

void Context::defaulted(const Entry& section, std::string_view key, const std::string& what) {
  remarks.defaults.push_back(fmt::format("{}:{} {} has no {}: {}", section.file, section.line,
                                         section.label.empty() ? section.key : section.key + " " + section.label, key,
                                         what));
}

std::string with_unit(double value, const char* unit) {
  return *unit == '\0' ? number_text(value) : number_text(value) + " " + unit;
}

}  // namespace tunica::peer_cases
