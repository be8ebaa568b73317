// @ts-check
// What the graphics card runs: one program for surfaces, one for their depth as the light sees it, one for the floor.

const VERTEX = `#version 300 es
in vec3 position; in vec2 normal; in vec2 uv; in vec4 color;
uniform mat4 link, camera; uniform vec3 low, size; uniform vec4 uvBox;
out vec3 place, face; out vec2 texel; out vec4 tint;
vec3 unfolded(vec2 p) {  // an octahedron's square back to a unit vector
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return normalize(n);
}
void main() {
  vec4 moved = link * vec4(low + position * size, 1.0);
  place = moved.xyz;
  face = mat3(link) * unfolded(normal);
  texel = uvBox.xy + uv * uvBox.zw;
  tint = color;
  gl_Position = camera * moved;
}`;

// The same light as in the still pictures: a soft key light, a bright sky, simple reflections.
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 place, face; in vec2 texel; in vec4 tint;
uniform vec3 eye, toward; uniform mat4 lamp; uniform highp sampler2DShadow shadows; uniform float grain;
uniform vec4 base, mark; uniform vec3 glow, look;  // look: metallic, roughness, alpha cutoff (negative: none)
uniform sampler2D image; uniform bool textured; uniform float floorHeight, height;
out vec4 result;
float lit(vec3 n) {
  vec3 p = (lamp * vec4(place + n * grain, 1.0)).xyz * 0.5 + 0.5;
  float sum = 0.0;
  for (int x = -1; x <= 1; x++) for (int y = -1; y <= 1; y++)
    sum += texture(shadows, vec3(p.xy + vec2(x, y) * 1.4 / float(textureSize(shadows, 0).x), p.z - 0.0006));
  return sum / 9.0;
}
float surroundings(vec3 m, float rough) {
  float blur = 0.1 + 0.7 * rough;
  float above = clamp(0.5 + 0.5 * m.z / blur, 0.0, 1.0);
  float box = clamp((dot(m, toward) - 1.0 + blur) / blur, 0.0, 1.0);
  float strip = clamp(1.0 - abs(m.x - 0.35) / (0.6 * blur), 0.0, 1.0) * above;
  return 0.22 + 0.62 * above + (1.15 - rough) * (1.1 * box * box + 0.55 * strip);
}
void main() {
  vec4 paint = base * tint;
  if (textured) paint *= texture(image, texel);
  if (look.z >= 0.0) { if (paint.a < look.z) discard; paint.a = 1.0; }
  vec3 view = normalize(eye - place), n = normalize(face);
  if (dot(n, view) < 0.0) n = -n;
  float key = lit(n), rough = look.y;
  float near = clamp((place.z - floorHeight) / (0.12 * height), 0.0, 1.0);
  float sky = mix(0.62, 1.0, key) * mix(0.72, 1.0, n.z > -0.5 ? max(near, step(0.5, n.z)) : near);
  float up = 0.5 + 0.5 * n.z;
  float diffuse = 0.78 * key * max(dot(n, toward), 0.0) + sky * (0.22 + 0.28 * up);
  vec3 mirror = reflect(-view, n);
  float gloss = surroundings(mirror, rough) * (0.35 + 0.65 * sky);
  float edge = 0.04 + 0.5 * pow(1.0 - clamp(dot(n, view), 0.0, 1.0), 5.0) * (1.0 - rough);
  vec3 light = paint.rgb * diffuse + edge * (1.0 - rough) * gloss;
  light = mix(light, paint.rgb * (1.15 * gloss + 0.3 * diffuse), look.x) + glow;
  light = mix(light, mark.rgb * (0.35 + 0.8 * diffuse), mark.a);
  light = mix(light, 0.7 + 0.3 * tanh((light - 0.7) / 0.3), step(0.7, light));
  vec3 shown = mix(12.92 * light, 1.055 * pow(max(light, 1e-5), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
  float alpha = max(paint.a, mark.a);
  result = vec4(shown * alpha, alpha);
}`;

const DEPTH_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 mark;
out vec4 result;
void main() { result = mark; }`;

const FLOOR_VERTEX = `#version 300 es
uniform mat4 camera; uniform vec4 span; uniform float floorHeight;
out vec3 place;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  place = vec3(mix(span.xy, span.zw, corner), floorHeight);
  gl_Position = camera * vec4(place, 1.0);
}`;

// A shadow alone, on nothing: what is drawn is how dark the page is below the object.
const FLOOR_FRAGMENT = `#version 300 es
precision highp float;
in vec3 place;
uniform vec4 foot, span; uniform mat4 lamp; uniform highp sampler2DShadow shadows; uniform float height, strength;
out vec4 result;
void main() {
  vec2 out2 = max(max(foot.xy - place.xy, place.xy - foot.zw), 0.0);
  float soft = exp(-length(out2) / (0.09 * height));
  vec3 p = (lamp * vec4(place, 1.0)).xyz * 0.5 + 0.5;
  float sum = 0.0;
  for (int x = -2; x <= 2; x++) for (int y = -2; y <= 2; y++)
    sum += texture(shadows, vec3(p.xy + vec2(x, y) * 3.0 / float(textureSize(shadows, 0).x), p.z - 0.0008));
  vec2 rim = min(place.xy - span.xy, span.zw - place.xy) / (span.zw - span.xy);
  float fade = smoothstep(0.0, 0.25, min(rim.x, rim.y));
  result = vec4(0.0, 0.0, 0.0, strength * fade * (0.55 * soft + 0.4 * (1.0 - sum / 25.0)));
}`;
