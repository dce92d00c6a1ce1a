// Whether the data of one array of a VTK XML file are as many as they should be. The form of the data is described in
// "VTK XML Formats" (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tunica::mesh_io {

/// What the head of the file says about all its arrays.
struct VtkEncoding {
  bool big_endian = false;
  std::size_t header_bytes = 4;  ///< of the numbers before binary data
  std::string compressor{};      ///< class of VTK, empty: not compressed
};

struct VtkArray {
  enum class Form { ascii, base64, raw };

  std::string_view data;  ///< from their begin to the end of the file or tag
  Form form = Form::ascii;
  std::size_t value_bytes = 8;
  bool is_signed = true;  ///< of whole numbers
};

/// A compressed file may grow to this many times its size.
inline constexpr std::int64_t largest_expansion = 8000;

bool known_compressor(const std::string& name);
/// Nothing for what is no type of numbers.
std::optional<std::size_t> bytes_of_type(std::string_view type);

/// Why the data are not at least `values` numbers, in words; empty when they are.
std::string array_problem(const VtkArray& array, std::int64_t values, const VtkEncoding& encoding);

/// The whole number at this place of an array without problem; nothing when it does not decode.
std::optional<std::int64_t> value_at(const VtkArray& array, std::int64_t place, const VtkEncoding& encoding);

}  // namespace tunica::mesh_io
