// What is wrong with a scene in JSON: errors are collected and thrown together, and of the warnings
// so many are shown as somebody will read.
#pragma once

#include "base/text.h"
#include "desc/error_list.h"
#include "read/read_context.h"

#include <cstddef>

class JsonProblems {
public:
    JsonProblems(const SourceFile& source, const ReadContext& context)
        : source_(source), context_(context), errors_(source) {}

    // The text is made only when it will be shown.
    template <class MakeText> void error(SourceLoc loc, MakeText&& makeText) {
        errors_.add(loc, makeText);
    }
    template <class MakeText> void warn(SourceLoc loc, MakeText&& makeText) {
        if (++warningCount_ <= kShownWarnings) context_.warn(source_, loc.offset, makeText());
    }
    // Of something that the program does not know: an error, or as the user wishes a warning.
    template <class MakeText> void unknown(SourceLoc loc, MakeText&& makeText) {
        if (context_.options.lenient)
            warn(loc, makeText);
        else
            error(loc, makeText);
    }

    bool hasErrors() const { return errors_.count() > 0; }
    void finish() const {
        if (warningCount_ > kShownWarnings)
            context_.diagnostics.warnings.push_back(cat(
                source_.name, ": warning: and ", warningCount_ - kShownWarnings, " more warnings"));
        errors_.throwIfAny();
    }

private:
    static constexpr std::size_t kShownWarnings = 100;

    const SourceFile& source_;
    const ReadContext& context_;
    ErrorList errors_;
    std::size_t warningCount_ = 0;
};
