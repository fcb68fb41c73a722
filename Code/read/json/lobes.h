// The lobes of a material in JSON: a list "lobes" of objects with a "type", "weight", the fields of
// that type, and "covers". A value is a number, an array of three, or an object with that as
// "value" and a list "factors" of {"times": TEXTURE} and {"without": TEXTURE, "strength": S}.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/fields.h"
#include "read/json/names.h"

// Takes the key "lobes". Where there is one, nothing is diffuse unless it is said.
void readJsonLobes(JsonFields& fields, const JsonNames& textures, MaterialDesc& material);
