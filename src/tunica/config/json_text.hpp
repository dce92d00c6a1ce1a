// JSON as this program writes it.
#pragma once

#include <string>

namespace tunica::config {

/// Two blanks for each level. Names of files may hold bytes that are no UTF-8, which become U+FFFD: a name that cannot
/// be written must not cost what a stage has computed.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tunica::config
