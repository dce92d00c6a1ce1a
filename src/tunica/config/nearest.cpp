#include "tunica/config/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace tunica::config {
namespace {

// Twice the number of slips, so that a wrong case can count half.
int replacement(char a, char b) {
  if (a == b) return 0;
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return lower(a) == lower(b) ? 1 : 2;
}

// Optimal string alignment distance.
int distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> d((a.size() + 1) * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> int& { return d[i * columns + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = 2 * static_cast<int>(i + j);
        continue;
      }
      at(i, j) = std::min({at(i - 1, j) + 2, at(i, j - 1) + 2, at(i - 1, j - 1) + replacement(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 2);
    }
  }
  return d.back();
}

}  // namespace

std::string nearest(std::string_view wanted, std::span<const std::string> existing) {
  std::string best;
  int smallest = 2 * std::max(1, static_cast<int>(wanted.size()) / 3) + 1;
  for (const std::string& name : existing) {
    const int d = distance(wanted, name);
    if (d < smallest) {
      smallest = d;
      best = name;
    }
  }
  return best;
}

}  // namespace tunica::config
