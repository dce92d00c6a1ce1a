// Makes C++ source of files that a program carries within it, with the SHA-256 of each:
//   embed OUT.cpp NAMESPACE NAME FILE HEX [NAME FILE HEX]...
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace {

constexpr std::size_t longest_line = 2000;

/// The text as string literals, one a line. A digit after an octal escape would be taken for a part of it, so all
/// escapes have three.
void write_literals(std::ofstream& out, const std::string& text) {
  for (std::size_t i = 0; i < text.size(); i += longest_line) {
    out << "  \"";
    for (const char c : text.substr(i, longest_line)) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte >= 32 && byte < 127 && c != '"' && c != '\\' && c != '?') {
        out << c;
      } else {
        char escape[5];
        std::snprintf(escape, sizeof escape, "\\%03o", byte);
        out << escape;
      }
    }
    out << "\"\n";
  }
  if (text.empty()) out << "  \"\"\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc % 3 != 0) return std::fprintf(stderr, "usage: embed OUT NAMESPACE [NAME FILE HEX]...\n"), 2;
  std::ofstream out(argv[1]);
  out << "#include \"tunica/viewer/assets.hpp\"\n\nnamespace " << argv[2] << " {\n\n";
  for (int i = 3; i < argc; i += 3) {
    std::ifstream in(argv[i + 1], std::ios::binary);
    if (!in) return std::fprintf(stderr, "embed: cannot read %s\n", argv[i + 1]), 2;
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    out << "static constexpr char " << argv[i] << "_text[] =\n";
    write_literals(out, text);
    out << "  ;\nAsset " << argv[i] << "() { return {{" << argv[i] << "_text, " << text.size() << "}, \"" << argv[i + 2]
        << "\"}; }\n\n";
  }
  out << "}\n";
  out.close();
  return out ? 0 : 2;
}
