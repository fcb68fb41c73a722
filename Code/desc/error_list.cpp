#include "desc/validate.h"

#include "base/text.h"

#include <utility>

std::string ErrorList::locatedAt(SourceLoc loc, std::string_view what,
                                 std::string_view severity) const {
    if (loc.offset == SourceLoc::kUnknown) return cat(source_.name, ": ", severity, ": ", what);
    return located(source_, loc.offset, what, severity);
}

void ErrorList::addComplete(std::string message) {
    messages_.push_back(std::move(message));
    ++count_;
}

void ErrorList::throwIfAny() const {
    if (count_ == 0) return;
    std::string all = join(messages_, "\n");
    if (count_ > messages_.size())
        all += cat("\n", source_.name, ": error: and ", count_ - messages_.size(), " more errors");
    fail(ErrorKind::Input, all);
}
