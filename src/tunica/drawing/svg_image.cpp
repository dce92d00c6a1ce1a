#include "tunica/drawing/svg_image.hpp"

#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::drawing {
namespace {

using Document = std::unique_ptr<RsvgHandle, decltype(&g_object_unref)>;
using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

[[noreturn]] void refuse(GError* error) {
  const std::string message = error == nullptr ? "the document has no size in pixels" : error->message;
  g_clear_error(&error);
  throw std::invalid_argument("write_png: " + message);
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int bytes) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), bytes);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void write_png(const std::string& file, const std::string& svg, int scale) {
  GError* error = nullptr;
  const Document document(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error),
                          g_object_unref);
  double width = 0.0, height = 0.0;
  if (!document || rsvg_handle_get_intrinsic_size_in_pixels(document.get(), &width, &height) == FALSE) refuse(error);
  width *= scale;
  height *= scale;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width)),
                                                   static_cast<int>(std::lround(height))),
                        cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  const RsvgRectangle whole{0.0, 0.0, width, height};
  if (rsvg_handle_render_document(document.get(), context.get(), &whole, &error) == FALSE) refuse(error);
  std::string png;
  if (const auto status = cairo_surface_write_to_png_stream(surface.get(), append, &png);
      status != CAIRO_STATUS_SUCCESS)
    throw SolverError(fmt::format("cannot write {}: {}", file, cairo_status_to_string(status)));
  files::write_atomically(file, png);
}

}  // namespace tunica::drawing
