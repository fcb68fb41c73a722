// Where the items of a long JSON array stand, found many times faster than they are read: only the
// quotes and brackets are looked at, 64 bytes at a time.
#pragma once

#include <cstddef>
#include <vector>

// From behind an item, or from the array's '[', to behind another item: each has what stands before
// it in front.
struct JsonPart {
    const char* first = nullptr;
    const char* last = nullptr;
    char before = ','; // of the first item
};

struct JsonArrayScan {
    std::vector<JsonPart> parts;
    std::size_t items = 0;     // arrays and objects only
    const char* end = nullptr; // behind the ']'; nullptr when there is none
};

// Parts of about `partBytes`. Of a text that is no JSON they may be anything: whoever reads them
// finds that out, as parts that are all read up to their ends leave out nothing.
JsonArrayScan scanJsonArray(const char* open, const char* end, std::size_t partBytes);
