#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <string>

#include "editor/window/base/vtk_target.h"

namespace focalstage {
namespace {

using Sink = std::function<void(std::string_view)>;

class MessageWindow : public vtkOutputWindow {
 public:
  static MessageWindow* New();
  vtkTypeMacro(MessageWindow, vtkOutputWindow)

      void DisplayText(const char* text) override {
    std::string_view line = text == nullptr ? "" : text;
    while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.remove_suffix(1);
    if (sink && !line.empty()) sink(line);
  }

  Sink sink;

 protected:
  MessageWindow() = default;
};

vtkStandardNewMacro(MessageWindow)

}  // namespace

void send_vtk_messages_to(std::function<void(std::string_view)> sink) {
  vtkNew<MessageWindow> window;
  window->sink = std::move(sink);
  vtkOutputWindow::SetInstance(window);
}

}  // namespace focalstage
