// The arrays of a mesh block: the one place of a scene file where megabytes of numbers stand.
#pragma once

#include "desc/error_list.h"
#include "desc/scene_desc.h"
#include "read/txt/scanner.h"

// Reads from behind the '{' and its line end to behind the '}'. `open` is the word "mesh". Long
// arrays are read by so many threads.
void readMesh(Scanner& in, ErrorList& errors, const Token& open, MeshDesc& mesh, int threads = 1);
