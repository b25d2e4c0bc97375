#include "io/assets/obj_material.h"

#include <algorithm>

#include "io/assets/text_reader.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

/// Exporters on Windows write its separators.
std::string with_forward_slashes(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

/// A name in a library is relative to the library's folder.
std::string beside(const std::string& library, const std::string& name) {
  const std::size_t slash = library.rfind('/');
  return slash == std::string::npos ? name : library.substr(0, slash + 1) + name;
}

bool is_missing(const Fault& fault) { return fault.code == "asset.missing"; }

/// One number for all channels, or three.
bool read_color(TextReader& text, glm::dvec3& color) {
  const std::optional<double> red = number_from(text.word());
  if (!red) return false;
  color = glm::dvec3(*red);
  if (text.at_end_of_line()) return true;
  const std::optional<double> green = number_from(text.word());
  const std::optional<double> blue = number_from(text.word());
  if (!green || !blue) return false;
  color = {*red, *green, *blue};
  return true;
}

}  // namespace

int ObjMaterials::index_of(const std::string& name) const {
  const auto found = index_by_name_.find(name);
  return found == index_by_name_.end() ? -1 : found->second;
}

void ObjMaterials::warn(const std::string& code, const std::string& where, const std::string& what) {
  findings.push_back(asset_finding(Severity::warning, code, where, what));
}

Status ObjMaterials::read_library(const std::string& name) {
  const std::string library = with_forward_slashes(name);
  const Result<std::span<const std::byte>> bytes = obj_.companion(library);
  if (bytes) return read(library, *bytes);
  if (!is_missing(bytes.fault())) return bytes.fault();
  warn("asset.material-missing", library, "the material library is not there; what uses it is white");
  return {};
}

Status ObjMaterials::read(const std::string& library, std::span<const std::byte> bytes) {
  TextReader text(bytes, library);
  Material* material = nullptr;
  while (text.next_line()) {
    const std::string_view key = text.word();
    if (key == "newmtl") {
      const std::string name(text.rest_of_line());
      index_by_name_[name] = static_cast<int>(materials_.size());
      material = &materials_.emplace_back();
      material->name = name;
      continue;
    }
    if (material == nullptr) continue;
    if (key == "Kd") {
      glm::dvec3 color;
      if (!read_color(text, color)) {
        warn("asset.material-left-out", text.where(), "this colour is no RGB; it stays white");
      } else if (color.r < 0 || color.g < 0 || color.b < 0) {
        return text.invalid("a colour is negative");
      } else {
        material->base_color = color;
      }
    } else if (key == "map_Kd") {
      if (Status read = read_texture(library, std::string(text.rest_of_line()), text.where()); !read) return read;
    } else if ((key == "d" && number_from(text.word()).value_or(1.0) < 1.0) ||
               (key == "Tr" && number_from(text.word()).value_or(0.0) > 0.0)) {
      findings.push_back(asset_finding(Severity::info, "asset.drawn-opaque", text.where(),
                                       "the material lets light through; it is drawn opaque"));
    }
  }
  return {};
}

Status ObjMaterials::read_texture(const std::string& library, const std::string& name, const std::string& where) {
  if (name.starts_with('-')) {
    warn("asset.material-left-out", where, "a texture with options is left out");
    return {};
  }
  const std::string path = beside(library, with_forward_slashes(name));
  std::shared_ptr<const Texture>& texture = textures_[path];
  if (!texture) {
    const Result<std::span<const std::byte>> bytes = obj_.companion(path);
    if (!bytes && !is_missing(bytes.fault())) return bytes.fault();
    if (!bytes) {
      warn("asset.texture-missing", where, "the texture " + path + " is not there; its colour alone is used");
      return {};
    }
    Result<Texture> decoded = decode_image(*bytes, path, PixelBits::as_stored);
    if (!decoded) return decoded.fault();
    texture = std::make_shared<const Texture>(*std::move(decoded));
  }
  materials_.back().texture = texture;
  return {};
}

}  // namespace focalstage
