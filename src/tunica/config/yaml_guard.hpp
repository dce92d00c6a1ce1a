// What a YAML text may be made of, looked at before a tree of it is built: a tree that contains itself, or that a few
// lines multiply to millions of nodes, cannot be walked.
#pragma once

#include <string>

namespace tunica::config {

/// Throws InputError, with line and column, for bytes that are no text, an alias inside its own anchor, aliases that
/// expand to more than a hundred thousand values, sections nested too deeply, and keys longer than a line; also
/// YAML::Exception for what is no YAML. `name` is for the message.
void refuse_unreadable_yaml(const std::string& yaml, const std::string& name);

}  // namespace tunica::config
