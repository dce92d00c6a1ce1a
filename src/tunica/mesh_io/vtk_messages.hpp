// VTK reports errors through observers and prints them when there is none; this keeps the first one instead. For .cpp
// files only that use VTK anyway: VTK's classes are left incomplete here.
#pragma once

#include <memory>
#include <string>

class vtkAlgorithm;

namespace tunica::mesh_io {

/// Listens to an algorithm and its executive, from its construction on.
class FirstVtkMessage {
 public:
  explicit FirstVtkMessage(vtkAlgorithm* algorithm);
  /// Without the name of VTK's source file; empty when there was no error.
  const std::string& text() const { return *text_; }

 private:
  std::shared_ptr<std::string> text_;
};

}  // namespace tunica::mesh_io
