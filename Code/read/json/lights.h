// The lights of a JSON scene, as LightDesc.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/json.h"
#include "read/json/fields.h"

#include <vector>

void readJsonLights(JsonFields& scene, const JsonRules& rules, std::vector<LightDesc>& lights);
