// VTK reports errors through observers, or to its output window and its log when there is none; this keeps the first
// one instead. For .cpp files only that use VTK anyway: VTK's classes are left incomplete here.
#pragma once

#include <memory>
#include <string>

class vtkAlgorithm;
class vtkObject;

namespace tunica::mesh_io {

/// Listens to an algorithm, its executive and, as long as it lives, to every object of VTK that nobody listens to;
/// nothing is printed meanwhile. Its objects must end in the reverse order of their making.
class FirstVtkMessage {
 public:
  explicit FirstVtkMessage(vtkAlgorithm* algorithm);
  ~FirstVtkMessage();
  FirstVtkMessage(const FirstVtkMessage&) = delete;
  FirstVtkMessage& operator=(const FirstVtkMessage&) = delete;

  /// Without the name of VTK's source file; empty when there was no error.
  const std::string& text() const { return *text_; }

 private:
  class Silence;

  std::shared_ptr<std::string> text_;
  std::unique_ptr<Silence> silence_;
};

}  // namespace tunica::mesh_io
