#include "tunica/mesh_io/vtk_messages.hpp"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace tunica::mesh_io {

namespace {

using Text = std::shared_ptr<std::string>;

/// Stores the first message that it is called with.
vtkNew<vtkCallbackCommand> keeper_of(const Text& kept) {
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback([](vtkObject*, unsigned long, void* keep, void* message) {
    auto& text = **static_cast<Text*>(keep);
    if (!text.empty() || !message) return;
    text = static_cast<const char*>(message);
    // VTK puts "ERROR: In <source file>, line <n>\n<class> (<address>): " before what it has to say.
    if (const auto prefix = text.rfind("): "); prefix != std::string::npos) text = text.substr(prefix + 3);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (text.empty()) text = "VTK gives no reason";
  });
  // The observer may outlive its maker with the algorithm, so it shares the text.
  observer->SetClientData(new Text(kept));
  observer->SetClientDataDeleteCallback([](void* keep) { delete static_cast<Text*>(keep); });
  return observer;
}

}  // namespace

/// Takes the place of VTK's output window, and keeps its log from the terminal.
class FirstVtkMessage::Silence {
 public:
  explicit Silence(const Text& text) {
    vtkNew<vtkOutputWindow> window;
    window->SetDisplayModeToNever();
    window->AddObserver(vtkCommand::ErrorEvent, keeper_of(text));
    vtkOutputWindow::SetInstance(window);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Silence() {
    vtkOutputWindow::SetInstance(window_);
    vtkLogger::SetStderrVerbosity(verbosity_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  vtkSmartPointer<vtkOutputWindow> window_ = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
};

FirstVtkMessage::FirstVtkMessage(vtkAlgorithm* algorithm)
    : text_(std::make_shared<std::string>()), silence_(std::make_unique<Silence>(text_)) {
  const auto observer = keeper_of(text_);
  algorithm->AddObserver(vtkCommand::ErrorEvent, observer);
  algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
}

FirstVtkMessage::~FirstVtkMessage() = default;

}  // namespace tunica::mesh_io
