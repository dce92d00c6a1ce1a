// The case files of the stages, and those of variants of a case that share what its stages have done. On rank 0, when
// the stages before are done; paths in a document count from `folder`.
#pragma once

#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

/// What the settings of a case file are, made once.
template <class T>
const config::Description* description_of() {
  static const auto description = T::schema().description();
  return description.get();
}

config::Document mesh_document(const Chain& chain, const std::filesystem::path& folder);
config::Document fibres_document(const Chain& chain, const std::filesystem::path& folder);
config::Document prestress_document(const Chain& chain, const std::filesystem::path& folder);
config::Document outlets_document(const Chain& chain, const std::filesystem::path& folder);
config::Document run_document(const Chain& chain, const std::filesystem::path& folder);
config::Document post_document(const Chain& chain, const std::filesystem::path& folder);
config::Document report_document(const Chain& chain, const std::filesystem::path& folder);

/// The case with the mesh, directions and outlets that its stages have made, and its other stages still to be done.
/// Where the case itself starts from the end of a beat with its tuned outlets, this one, which cannot, computes a
/// leading beat before those that are asked for.
config::Document case_on_common_mesh(const Chain& chain, const std::filesystem::path& folder);

/// The case with the outlets that its stage has made and everything else still to be done, each stage in its own place
/// below `folder`. With a leading beat as case_on_common_mesh().
config::Document case_with_common_outlets(const Chain& chain, const std::filesystem::path& folder);

/// The case with mesh, directions, outlets, prestress and the state to start from that its stages have made.
config::Document case_on_common_start(const Chain& chain, const std::filesystem::path& folder);

/// Steps for one more beat before those that are asked for, and the window of figures as much later, where the case
/// itself starts from the end of a beat with its tuned outlets: for a case that does not, or whose beat is another one.
void add_leading_beat(const Chain& chain, config::Document& document);

}  // namespace tunica::pipeline
