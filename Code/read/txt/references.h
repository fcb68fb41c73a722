// References: the names that blocks of a native scene file use for others, as positions. What was
// read before is known at once; the others wait until the whole file is known.
#pragma once

#include "desc/enum_tables.h"
#include "desc/validate.h"
#include "desc/name_table.h"
#include "desc/properties.h"
#include "read/txt/scanner.h"

#include <array>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// By target. Of equal names the first counts; validate() complains about the others.
using NameTables = std::array<NameTable, kNamesByValue<BlockType>.size()>;

class References {
public:
    // Of a part of a file nothing is known at once, as other names may be in front of it: its own
    // are listed for whoever knows all parts.
    References(const SourceFile& source, bool isPart) : source_(&source), isPart_(isPart) {}

    // A block has this name.
    void define(BlockType target, const Token& name, std::size_t number) {
        const auto t = static_cast<std::size_t>(target);
        const std::string_view text = keptText(name);
        if (isPart_)
            listed_[t].push_back({text, NameTable::hashOf(text)});
        else
            known_[t].insert(text, static_cast<std::uint32_t>(number));
    }
    // All names so far, where this is no part.
    const NameTables& known() const { return known_; }
    // The names of all parts, which must stay.
    static NameTables namesOf(std::span<const References* const> parts);
    // The position of the name, or a number below kNone that resolve() makes one of.
    Handle use(BlockType target, const Token& name);

    // What is left in these blocks, by the names of all. What nothing has becomes an error.
    void resolve(SceneDesc& desc, const NameTables& names, ErrorList& errors) const;
    bool isComplete() const { return waiting_.empty(); }

private:
    static Handle waitingAs(std::size_t i) { return -2 - static_cast<Handle>(i); }
    std::string_view keptText(const Token& name);

    const SourceFile* source_;
    bool isPart_;
    NameTables known_;
    struct Listed {
        std::string_view name;
        std::uint32_t hash;
    };
    std::array<std::vector<Listed>, kNamesByValue<BlockType>.size()> listed_; // in their order
    std::deque<std::string> quoted_; // names that are written otherwise than they are
    std::vector<Token> waiting_;
};
