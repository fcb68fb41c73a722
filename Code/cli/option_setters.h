// What the rows of render_flags.cpp call: from the value of an option into Options. They fail with
// ErrorKind::Usage, as FlagValue does.
#pragma once

#include "cli/flag.h"
#include "cli/options.h"
#include "desc/enum_tables.h"

#include <string>
#include <string_view>
#include <vector>

inline constexpr const char* kActionGroup = "instead of a picture";

template <class E> std::vector<std::string> namesOf() {
    return {kNamesByValue<E>.begin(), kNamesByValue<E>.end()};
}

template <class E> E enumValue(const FlagValue& value) {
    return static_cast<E>(value.choice(namesOf<E>()));
}

// "a|b|c", as --help shows what an option can be.
template <class E> std::string alternatives() { return join(namesOf<E>(), "|"); }

// A number that may be what it may be in a scene file.
int wholeLike(std::string_view keyword, const FlagValue& value);
double numberLike(std::string_view keyword, const FlagValue& value);

// Two different things to do do not fit together; --help wins over everything.
void setAction(Options& o, Options::Action action, const FlagValue& value);
void setScale(Options& o, const FlagValue& value);
void setResolution(Options& o, const FlagValue& value);
void setCrop(Options& o, const FlagValue& value);
void setBackground(Options& o, const FlagValue& value);
void setError(Options& o, const FlagValue& value);  // [worst:]E[:UNIT]
void setFilter(Options& o, const FlagValue& value); // NAME or NAME,WIDTH
void setAovs(Options& o, const FlagValue& value);   // NAME,NAME,...
// --textures, --textures=DIR, --no-textures
void setTextures(Options& o, const FlagValue& value);
void setSeed(Options& o, const FlagValue& value);
void setConvert(Options& o, const FlagValue& value);
