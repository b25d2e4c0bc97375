#include "tests/bench/gl_program.h"

#include <cstdio>
#include <sstream>
#include <string>

namespace focalstage::bench {
namespace {

GLuint shader(GLenum kind, const std::string& text) {
  const GLuint made = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(made, 1, &source, nullptr);
  glCompileShader(made);
  return made;
}

GLuint program(const std::string& vertex, const std::string& fragment) {
  const GLuint made = glCreateProgram();
  const GLuint parts[] = {shader(GL_VERTEX_SHADER, "#version 330 core\n" + vertex),
                          shader(GL_FRAGMENT_SHADER, "#version 330 core\n" + fragment)};
  for (const GLuint part : parts) glAttachShader(made, part);
  glLinkProgram(made);
  for (const GLuint part : parts) glDeleteShader(part);
  GLint linked = GL_FALSE;
  glGetProgramiv(made, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return made;
  char log[2000] = "";
  glGetProgramInfoLog(made, sizeof log, nullptr, log);
  std::fprintf(stderr, "%s\n", log);
  glDeleteProgram(made);
  return 0;
}

constexpr const char* eye_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
uniform mat4 eye_from_mesh;
uniform mat4 clip_from_eye;
out float depth;
out vec2 at;
void main() {
  vec4 eye = eye_from_mesh * vec4(position, 1.0);
  depth = -eye.z;
  at = uv;
  gl_Position = clip_from_eye * eye;
})";

/// One output: `light` of slice n, by the linear rule between sorted powers, at the look through its lens.
std::string slice_light(const std::vector<double>& powers_d, std::size_t n, double lens_to_pupil_m) {
  std::ostringstream text;
  text.precision(9);
  text << std::fixed << "  {\n    float st = from_pupil / (from_pupil - " << powers_d[n] * lens_to_pupil_m
       << " * d_p);\n"
       << "    vec2 look = straight * st;\n"
       << "    vec2 seen = texture(eye_image, (look - low) * per_size).rg;\n"
       << "    float d_plane = offset / (normal.x * look.x + normal.y * look.y - normal.z) - " << lens_to_pupil_m
       << ";\n"
       << "    float wanted = 1.0 / d_plane - 1.0 / (seen.g - " << lens_to_pupil_m << ");\n"
       << "    float weight = 1.0;\n";
  if (n > 0) {
    text << "    weight = min(weight, (wanted - " << powers_d[n - 1] << ") * " << 1.0 / (powers_d[n] - powers_d[n - 1])
         << ");\n";
  }
  if (n + 1 < powers_d.size()) {
    text << "    weight = min(weight, (" << powers_d[n + 1] << " - wanted) * " << 1.0 / (powers_d[n + 1] - powers_d[n])
         << ");\n";
  }
  text << "    light" << n << " = max(weight, 0.0) * seen.r;\n  }\n";  // no light where nothing is met
  return text.str();
}

}  // namespace

GLuint object_program_gl() {
  return program(eye_vertex, R"(
in float depth;
in vec2 at;
uniform float first, second;
uniform vec2 squares;
layout(location = 0) out vec2 light_and_depth;
void main() {
  vec2 cell = floor(at * squares);
  light_and_depth = vec2(mod(cell.x + cell.y, 2.0) < 0.5 ? first : second, depth);
})");
}

SurfaceProgram surface_program(const std::vector<double>& powers_d, const std::vector<std::size_t>& slices,
                               double lens_to_pupil_m, bool surfaces_hide) {
  std::ostringstream text;
  text << "in vec3 point;\nuniform sampler2D eye_image;\nuniform sampler2D surface_depth;\nuniform vec2 low, "
          "per_size;\n";
  for (std::size_t i = 0; i < slices.size(); ++i) {
    text << "layout(location = " << i << ") out float light" << slices[i] << ";\n";
  }
  text << "void main() {\n"
       << "  vec3 normal = cross(dFdx(point), dFdy(point));\n"
       << "  float offset = dot(normal, point);\n"
       << "  float from_pupil = -point.z;\n"
       << "  float d_p = from_pupil - " << lens_to_pupil_m << ";\n"
       << "  vec2 straight = point.xy / from_pupil;\n";
  for (const std::size_t n : slices) text << slice_light(powers_d, n, lens_to_pupil_m);
  if (surfaces_hide) {
    // A depth map is only as fine as its texels: the tolerance must cover a texel's slope.
    text << "  if (texture(surface_depth, (straight - low) * per_size).r < from_pupil * 0.995) {\n";
    for (const std::size_t n : slices) text << "    light" << n << " = 0.0;\n";
    text << "  }\n";
  }
  text << "}\n";
  SurfaceProgram made;
  made.id = program(R"(
layout(location = 0) in vec3 position;
uniform mat4 eye_from_mesh;
uniform mat4 clip_from_mesh;
out vec3 point;
void main() {
  point = (eye_from_mesh * vec4(position, 1.0)).xyz;
  gl_Position = clip_from_mesh * vec4(position, 1.0);
})",
                    text.str());
  if (made.id != 0) {
    glUseProgram(made.id);
    glUniform1i(glGetUniformLocation(made.id, "eye_image"), 0);
    glUniform1i(glGetUniformLocation(made.id, "surface_depth"), 1);
  }
  made.depth_id =
      program(eye_vertex, "in float depth;\nlayout(location = 0) out float value;\nvoid main() { value = depth; }");
  return made;
}

}  // namespace focalstage::bench
