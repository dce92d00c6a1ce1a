#include "tunica/mesh_io/vtk_messages.hpp"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

namespace tunica::mesh_io {

FirstVtkMessage::FirstVtkMessage(vtkAlgorithm* algorithm) : text_(std::make_shared<std::string>()) {
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback([](vtkObject*, unsigned long, void* keep, void* message) {
    auto& text = **static_cast<std::shared_ptr<std::string>*>(keep);
    if (!text.empty() || !message) return;
    text = static_cast<const char*>(message);
    // VTK puts "ERROR: In <source file>, line <n>\n<class> (<address>): " before what it has to say.
    if (const auto prefix = text.rfind("): "); prefix != std::string::npos) text = text.substr(prefix + 3);
    while (!text.empty() && text.back() == '\n') text.pop_back();
  });
  // The observer may outlive this object with the algorithm, so it shares the text.
  observer->SetClientData(new std::shared_ptr<std::string>(text_));
  observer->SetClientDataDeleteCallback([](void* keep) { delete static_cast<std::shared_ptr<std::string>*>(keep); });
  algorithm->AddObserver(vtkCommand::ErrorEvent, observer);
  algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
}

}  // namespace tunica::mesh_io
