#include "cli/completion.h"

#include "cli/diff.h"
#include "cli/options.h"

#include <algorithm>

namespace {

// The two ways to call the program, each with its table.
struct Tables {
    Options options;
    DiffOptions diffOptions;
    std::vector<Flag> main = renderFlags(options);
    std::vector<Flag> diff = diffFlags(diffOptions);
};

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
    return text;
}

// For 'single quotes' of bash and zsh.
std::string quoteSafe(const std::string& text) { return replaced(text, "'", "'\\''"); }

// ---- bash

std::string bashCases(const std::vector<Flag>& flags) {
    std::string out = "    case $flag in\n";
    for (const Flag& flag : flags) {
        if (flag.value == Flag::Value::None) continue;
        std::string action = ":"; // a value that nobody can guess: nothing is offered
        if (!flag.choices.empty()) action = "_raytracer_words '" + join(flag.choices, " ") + "'";
        if (flag.files == Flag::Files::Any) action = "_raytracer_files -f";
        if (flag.files == Flag::Files::Folders) action = "_raytracer_files -d";
        // An optional value is part of its word, so what follows a blank is something else.
        const bool onlyAttached = flag.value == Flag::Value::Optional && !flag.choices.empty();
        out += cat("    ", flag.name, flag.alias.empty() ? "" : "|" + flag.alias, ") ",
                   onlyAttached ? "[[ $attached ]] && { " + action + "; return; } ;;"
                                : action + "; return ;;",
                   "\n");
    }
    return out + "    esac\n    [[ $word == -* ]] && { _raytracer_words '" +
           join(flagNames(flags), " ") + "'; return; }\n    _raytracer_files -f\n";
}

std::string bashScript(const Tables& tables) {
    return cat(R"(# Completion of raytracer for bash; made by: raytracer --completion bash
_raytracer_words() {
    # In a list with commas the last word is completed.
    local before=
    [[ $word == *,* ]] && before=${word%,*},
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${word##*,}")
}
_raytracer_files() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen "$1" -- "$word")
}
_raytracer_main() {
)",
               bashCases(tables.main), "}\n_raytracer_diff() {\n", bashCases(tables.diff), R"(}
_raytracer() {
    local word=${COMP_WORDS[COMP_CWORD]} flag=${COMP_WORDS[COMP_CWORD-1]} attached=
    COMPREPLY=()
    # bash makes three words of --flag=value.
    if [[ $word == = ]]; then
        word= attached=1
    elif [[ $flag == = ]]; then
        flag=${COMP_WORDS[COMP_CWORD-2]} attached=1
    fi
    if [[ ${COMP_WORDS[1]} == diff && $COMP_CWORD -gt 1 ]]; then
        _raytracer_diff
    else
        _raytracer_main
        [[ $COMP_CWORD == 1 && diff == "$word"* ]] && COMPREPLY+=(diff)
    fi
}
complete -F _raytracer raytracer
)");
}

// ---- zsh

std::string zshSpecs(const std::vector<Flag>& flags) {
    std::string out;
    for (const Flag& flag : flags) {
        std::string help = flag.help;
        for (const char* special : {"\\", "[", "]", ":"})
            help = replaced(help, special, std::string("\\") + special);
        help = quoteSafe(help);
        std::string value;
        if (flag.value != Flag::Value::None) {
            value = cat(flag.value == Flag::Value::Optional ? "::" : ":",
                        replaced(flag.argument, ":", "\\:"), ":");
            if (!flag.choices.empty()) value += "(" + join(flag.choices, " ") + ")";
            if (flag.files == Flag::Files::Any) value += "_files";
            if (flag.files == Flag::Files::Folders) value += "_files -/";
        }
        const bool needsWord = flag.value == Flag::Value::Required;
        const bool attachedOnly = flag.value == Flag::Value::Optional;
        out += cat("        '", flag.name,
                   needsWord      ? "="
                   : attachedOnly ? "=-"
                                  : "",
                   "[", help, "]", value, "' \\\n");
        if (!flag.alias.empty())
            out +=
                cat("        '", flag.alias, needsWord ? "+" : "", "[", help, "]", value, "' \\\n");
        if (flag.negatable)
            out += cat("        '", flag.negatedName(), "[without: ", help, "]' \\\n");
    }
    return out;
}

std::string zshScript(const Tables& tables) {
    return cat(R"(#compdef raytracer
# Completion of raytracer for zsh; made by: raytracer --completion zsh
_raytracer() {
    if [[ $words[2] == diff && $CURRENT -gt 2 ]]; then
        shift words
        (( CURRENT-- ))
        _arguments -S \
)",
               zshSpecs(tables.diff), R"(        '1:picture:_files' '2:picture:_files'
    else
        _arguments -S \
)",
               zshSpecs(tables.main),
               R"(        '1:scene or diff:{ compadd diff; _files }' '2:picture:_files'
    fi
}
if [[ $funcstack[1] == _raytracer ]]; then _raytracer "$@"; else compdef _raytracer raytracer; fi
)");
}

// ---- fish

std::string fishLines(const std::vector<Flag>& flags, const std::string& condition) {
    std::string out;
    for (const Flag& flag : flags) {
        const std::string help = replaced(replaced(flag.help, "\\", "\\\\"), "'", "\\'");
        const auto line = [&](const std::string& name, const std::string& rest) {
            out += cat("complete -c raytracer -n '", condition, "' -l ", name.substr(2),
                       flag.alias.empty() || name != flag.name ? "" : " -s " + flag.alias.substr(1),
                       rest, " -d '", help, "'\n");
        };
        std::string value;
        if (flag.value == Flag::Value::Required)
            value = flag.files == Flag::Files::Any ? " -r -F" : " -x";
        if (flag.files == Flag::Files::Folders)
            value += " -a '(__fish_complete_directories)'";
        else if (!flag.choices.empty())
            value += " -a '" + join(flag.choices, " ") + "'";
        // fish has no optional values: the two spellings are two words.
        if (flag.value == Flag::Value::Optional && flag.files != Flag::Files::Folders)
            value.clear();
        line(flag.name, value);
        if (flag.value == Flag::Value::Optional && !flag.choices.empty())
            for (const std::string& choice : flag.choices) line(flag.name + "=" + choice, "");
        if (flag.negatable) line(flag.negatedName(), "");
    }
    return out;
}

std::string fishScript(const Tables& tables) {
    return cat(
        "# Completion of raytracer for fish; made by: raytracer --completion fish\n",
        fishLines(tables.main, "not __fish_seen_subcommand_from diff"),
        "complete -c raytracer -n '__fish_use_subcommand' -a diff -d 'compares two pictures'\n",
        fishLines(tables.diff, "__fish_seen_subcommand_from diff"));
}

} // namespace

std::string completionScript(const std::string& shell) {
    const Tables tables;
    if (shell == "zsh") return zshScript(tables);
    if (shell == "fish") return fishScript(tables);
    return bashScript(tables);
}
