#include "tunica/stages/time_stamp.hpp"

#include <ctime>

namespace tunica::stages {

std::string time_stamp() {
  const std::time_t t = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&t, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace tunica::stages
