// References: the names that blocks of a native scene file use for others, as positions. What was
// read before is known at once; the others wait until the whole file is known.
#pragma once

#include "desc/enum_tables.h"
#include "desc/error_list.h"
#include "desc/name_table.h"
#include "desc/properties.h"
#include "read/txt/scanner.h"

#include <array>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

// By target. Of equal names the first counts; validate() complains about the others.
using NameTables = std::array<NameTable, kEnumNames<Target>.size()>;
// Adds the names of some blocks, behind those that are there.
struct NameCounts {
    std::uint32_t textures = 0, materials = 0, meshes = 0;
};
void addNames(NameTables& names, NameCounts& before, const SceneDesc& desc);

class References {
public:
    // Of a part of a file in front of which there may be other names, nothing is known at once.
    References(const SourceFile& source, bool isFirst) : source_(&source), isFirst_(isFirst) {}

    // A block has this name.
    void define(Target target, const Token& name, std::size_t number) {
        if (isFirst_)
            known_[static_cast<std::size_t>(target)].insert(keptText(name),
                                                            static_cast<std::uint32_t>(number));
    }
    // The position of the name, or a number below kNone that resolve() makes one of.
    Handle use(Target target, const Token& name);

    // What is left in these blocks, by the names of all. What nothing has becomes an error.
    void resolve(SceneDesc& desc, const NameTables& names, ErrorList& errors) const;
    bool isComplete() const { return waiting_.empty(); }

private:
    static Handle waitingAs(std::size_t i) { return -2 - static_cast<Handle>(i); }
    std::string_view keptText(const Token& name);

    const SourceFile* source_;
    bool isFirst_;
    NameTables known_;
    std::deque<std::string> quoted_; // names that are written otherwise than they are
    std::vector<Token> waiting_;
};
