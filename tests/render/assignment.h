// A second renderer for the JSON scenes of the course COMP 557, to compare ours with: written from
// the assignment's conventions alone, in double, one object after the other, sharing nothing with
// Code/ but the JSON parser and the vector type.
//
// The conventions, where a handout leaves room in the reading that most solutions have:
//  Picture    Sample (i, j) of n x n lies in the middle of its cell, n = 1 in the middle of the
//             pixel. Unclamped samples are averaged, clamped to [0,1] and rounded to round(255 c).
//             No gamma. Where nothing is hit the picture is black. (In 2025 n is the number of
//             rays, all through the middle without jitter; n x n here as in the years before.)
//  Camera     w = normalize(position - lookAt), u = normalize(up x w), v = w x u; `fov` (2025:
//             `fovy`) is the vertical angle, top to bottom edge of the picture.
//  Normals    Outward, of planes the given one, of meshes the flat one of the corners' order; never
//             turned to the eye: the back of a plane shows only what its front receives.
//  Light      ambient * diffuse, once, without attenuation or shadow, plus for each light
//             colour * power / (a d^2 + b d + c) * (diffuse * N.L + specular * (N.H)^exponent) with
//             H = normalize(L + V). A light behind the surface (N.L <= 0) gives no highlight
//             either. Directional lights point to the light and know no distance.
//  Shadows    Hard; anything strictly between the point and the light, both sides of everything.
//  Planes     Two materials: the first where floor(x) + floor(z) is even, x and z in the space
//             that the plane stands in, whatever its position and normal. 2025: in its own space,
//             so its position, rotation and scale move the squares.
//  Placing    M = T Rx Ry Rz S for nodes and instances. Positions of other objects move them; in
//             2025 all objects have the whole M. Meshes: (v + position) * scale, in 2025 M v.
//  Instances  W2024: a node with a `ref` is the earlier top-level node with its own M replaced.
//             2024, 2025: type "instance", M times any earlier object's own placing; the nodes
//             around that object don't come along.
//  Materials  Those that the object names, else the first of the nearest node around it. Unknown
//             IDs are dropped; what is left without a material is not drawn.
#pragma once

#include "read/json/json.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace assignment {

using Pixel = std::array<std::uint8_t, 3>;
struct Picture {
    int width = 0, height = 0;
    std::vector<Pixel> pixels; // row after row from the top
    Pixel at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

// Jitter is left out. Mesh files are looked for from here, then in `folder`. Throws
// std::runtime_error for scenes that lack what the assignment requires.
Picture render(const JsonValue& json, const std::string& folder);

} // namespace assignment
