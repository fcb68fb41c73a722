// Picture, sampling and surroundings of a JSON scene: resolution, AA, ambient, settings, world.
#pragma once

#include "desc/scene_desc.h"
#include "read/json_dialect.h"
#include "read/json_fields.h"
#include "read/json_names.h"

void readJsonSettings(JsonFields& scene, const JsonRules& rules, SettingsDesc& settings);
void readJsonWorld(JsonFields& scene, const JsonNames& textures, WorldDesc& world);
