// The keys of an object in JSON that are rows of desc/properties.h. One value stands alone, several
// stand in an array: "radius": 2, "sensor": [36, 24], "filter": ["tent", 2]; the four corners of a
// quadrilateral are four arrays. What a row refers to is named by a text.
#pragma once

#include "desc/properties.h"
#include "read/json/fields.h"
#include "read/json/names.h"

#include <initializer_list>
#include <string_view>

// The texture that a value names; kNone after an error.
Handle readJsonTexture(const JsonValue& value, std::string_view key, const JsonNames& textures,
                       JsonProblems& problems);
void readJsonProperty(const JsonValue& value, const Property& row, const JsonNames& textures,
                      JsonProblems& problems, void* block);
void readJsonProperties(JsonFields& fields, const JsonNames& textures, BlockType type,
                        KindMask kinds, void* block,
                        std::initializer_list<std::string_view> except);
// All rows that exist for this kind of block, but those that the caller reads in a way of its own.
// Lights have all rows: validate() warns of those without effect.
template <class Block>
void readJsonProperties(JsonFields& fields, const JsonNames& textures, Block& block,
                        std::initializer_list<std::string_view> except = {}) {
    KindMask kinds = kAllKinds;
    if constexpr (Block::kType == BlockType::Object) kinds = only(block.kind);
    readJsonProperties(fields, textures, Block::kType, kinds, &block, except);
}
