// A quick way to read, which may give up: another way then reads all of it again, and tells.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <iterator>
#include <optional>

// read(context) with a context of its own. Its warnings count if it gives a scene; giving none and
// throwing Error are the same.
template <class Read>
std::optional<SceneDesc> attempt(const ReadContext& context, const Read& read) {
    Diagnostics said;
    std::optional<SceneDesc> scene;
    try {
        scene = read(ReadContext{context.options, said});
    } catch (const Error&) {
        return {};
    }
    if (scene)
        std::move(said.warnings.begin(), said.warnings.end(),
                  std::back_inserter(context.diagnostics.warnings));
    return scene;
}
