#include "cli/command.h"

#include "cli/options.h"

#include <algorithm>

namespace {

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
    return text;
}

// For 'single quotes' of bash and zsh.
std::string quoteSafe(const std::string& text) { return replaced(text, "'", "'\\''"); }

std::vector<std::string> commandNames() {
    std::vector<std::string> names;
    for (const Command& command : commands()) names.emplace_back(command.name);
    return names;
}

// ---- bash

// A function that completes with a table of options, and else with the words, or file names where
// there are none.
std::string bashFunction(std::string_view name, const std::vector<Flag>& flags,
                         const std::vector<std::string>& others) {
    std::string out = cat("_raytracer_", name, "() {\n    case $flag in\n");
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
    return cat(out, "    esac\n    [[ $word == -* ]] && { _raytracer_words '",
               join(flagNames(flags), " "), "'; return; }\n    ",
               others.empty() ? "_raytracer_files -f"
                              : cat("_raytracer_words '", join(others, " "), "'"),
               "\n}\n");
}

std::string bashScript(const std::vector<Flag>& flags) {
    std::string functions, cases;
    for (const Command& command : commands()) {
        functions += bashFunction(command.name, command.flags(), command.words());
        cases += cat("        ", command.name, ") _raytracer_", command.name, "; return ;;\n");
    }
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
)",
               bashFunction("main", flags, {}), functions, R"(_raytracer() {
    local word=${COMP_WORDS[COMP_CWORD]} flag=${COMP_WORDS[COMP_CWORD-1]} attached=
    COMPREPLY=()
    # bash makes three words of --flag=value.
    if [[ $word == = ]]; then
        word= attached=1
    elif [[ $flag == = ]]; then
        flag=${COMP_WORDS[COMP_CWORD-2]} attached=1
    fi
    if [[ $COMP_CWORD -gt 1 ]]; then
        case ${COMP_WORDS[1]} in
)",
               cases, R"(        esac
    fi
    _raytracer_main
    # The first word may be one of the commands as well.
    [[ $COMP_CWORD == 1 ]] && mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < \
        <(compgen -W ')",
               join(commandNames(), " "), R"(' -- "$word")
    return 0
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

std::string zshScript(const std::vector<Flag>& flags) {
    std::string cases;
    for (const Command& command : commands()) {
        const std::vector<std::string> words = command.words();
        cases += cat("        ", command.name,
                     ")\n        shift words\n        (( CURRENT-- ))\n        _arguments -S \\\n",
                     zshSpecs(command.flags()),
                     words.empty() ? "        '*:file:_files'\n"
                                   : cat("        '*:word:(", join(words, " "), ")'\n"),
                     "        return ;;\n");
    }
    return cat(R"(#compdef raytracer
# Completion of raytracer for zsh; made by: raytracer --completion zsh
_raytracer() {
    if (( CURRENT > 2 )); then
        case $words[2] in
)",
               cases, R"(        esac
    fi
    _arguments -S \
)",
               zshSpecs(flags), "        '1:scene or command:{ compadd ", join(commandNames(), " "),
               R"(; _files }' '2:picture:_files'
}
if [[ $funcstack[1] == _raytracer ]]; then _raytracer "$@"; else compdef _raytracer raytracer; fi
)");
}

// ---- fish

std::string quoteSafeForFish(const std::string& text) {
    return replaced(replaced(text, "\\", "\\\\"), "'", "\\'");
}

std::string fishLines(const std::vector<Flag>& flags, const std::string& condition) {
    std::string out;
    for (const Flag& flag : flags) {
        const std::string help = quoteSafeForFish(flag.help);
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

std::string fishScript(const std::vector<Flag>& flags) {
    std::string out =
        cat("# Completion of raytracer for fish; made by: raytracer --completion fish\n",
            fishLines(flags, "not __fish_seen_subcommand_from " + join(commandNames(), " ")));
    for (const Command& command : commands()) {
        const std::string isThis = cat("__fish_seen_subcommand_from ", command.name);
        out += cat("complete -c raytracer -n '__fish_use_subcommand' -a ", command.name, " -d '",
                   quoteSafeForFish(std::string(command.help)), "'\n",
                   fishLines(command.flags(), isThis));
        if (const auto words = command.words(); !words.empty())
            out += cat("complete -c raytracer -f -n '", isThis, "' -a '", join(words, " "), "'\n");
    }
    return out;
}

} // namespace

std::string completionScript(const std::string& shell) {
    Options unused;
    const std::vector<Flag> flags = renderFlags(unused);
    if (shell == "zsh") return zshScript(flags);
    if (shell == "fish") return fishScript(flags);
    return bashScript(flags);
}
