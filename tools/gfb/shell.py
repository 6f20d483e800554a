"""Shell completion and the man page, made from what `gfb --help` prints; tools/manual writes them into share/."""

import re

OPTION = re.compile(r"^  (--[a-z-]+)(?: ([A-Z]+))? {2,}(\S.*)$")


def options_of(text):
    """Option, the word for its value or nothing, and its meaning, of every line of the help."""
    found, last = [], None
    for line in text.splitlines():
        match = OPTION.match(line)
        if match:
            last = [match[1], match[2] or "", match[3]]
            found.append(last)
        elif last is not None and re.match(r"^ {18}\S", line):
            last[2] += " " + line.strip()
        else:
            last = None
    return found


def analyses_of(options):
    """The analyses that the meaning of --template lists, a blank between two."""
    meaning = next(meaning for name, _, meaning in options if name == "--template")
    return meaning.partition("; A: ")[2].replace(",", "")


def bash(options):
    """Completion for bash."""
    names = " ".join(name for name, _, _ in options)
    return f"""# bash completion of gfb, written by tools/manual from gfb --help
_gfb() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  case $before in
    --output) mapfile -t COMPREPLY < <(compgen -d -- "$word"); return ;;
    --template) mapfile -t COMPREPLY < <(compgen -W '{analyses_of(options)}' -- "$word"); return ;;
    {"|".join(name for name, value, _ in options if value == "FILE")}) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;;
    {"|".join(name for name, value, _ in options if value not in ("", "FILE") and name not in ("--output", "--template"))}) return ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W '{names} --petsc' -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X '!*.nml' -- "$word")
  fi
}}
complete -o filenames -F _gfb gfb
"""


def zsh(options):
    """Completion for zsh."""
    lines = []
    for name, value, meaning in options:
        words = re.sub(r"[\[\]':]", " ", meaning)
        action = {"--output": ":folder:_files -/", "--template": f":analysis:({analyses_of(options)})"} \
            .get(name, ":file:_files" if value == "FILE" else f":{value}:" if value else "")
        lines.append(f"  '{name}[{words}]{action}' \\\n")
    return ("#compdef gfb\n# zsh completion of gfb, written by tools/manual from gfb --help\n_arguments \\\n" + "".join(lines)
            + "  '--petsc[all that follows is for PETSc]:*:::options: ' \\\n  '*:case file:_files -g \"*.nml\"'\n")


def fish(options):
    """Completion for fish."""
    lines = ["# fish completion of gfb, written by tools/manual from gfb --help\n"]
    for name, value, meaning in options:
        words = meaning.replace("\\", "").replace("'", "\\'")
        more = {"--output": " -x -a '(__fish_complete_directories)'", "--template": f" -x -a '{analyses_of(options)}'"}
        lines.append(f"complete -c gfb -l {name[2:]}{more.get(name, ' -r' if value == 'FILE' else ' -x' if value else '')} -d '{words}'\n")
    return "".join(lines)


def man(text, version):
    """The man page."""
    head, _, rest = text.partition("\n\n")
    usage = head.replace("usage:", "").splitlines()
    statements, _, behind = rest.partition("\n\n")
    listed, _, foot = behind.partition("\n\n")
    lines = [f'.TH GFB 1 "" "gfb {version}" "User Commands"', ".SH NAME", r"gfb \- computes bump-type gas foil bearings", ".SH SYNOPSIS",
             ".nf", *(escaped(line.strip()) for line in usage), ".fi", ".SH DESCRIPTION", escaped(statements), ".SH OPTIONS"]
    for name, value, meaning in options_of(listed):
        lines += [".TP", rf"\fB{escaped(name)}\fR" + (rf" \fI{value}\fR" if value else ""), escaped(meaning)]
    lines += [".TP", r"\fB\-\-\fR", "case files follow, also such as begin with \\-", ".TP", r"\fB\-\-petsc\fR ...",
              "all that follows is for PETSc", ".SH FILES AND EXIT STATUS", ".nf", *(escaped(line) for line in foot.strip().splitlines()), ".fi",
              ".SH EXAMPLES", ".nf", r"gfb \-\-template equilibrium > my.nml", "gfb my.nml", r"gfb \-\-explain bearing%clearance", ".fi"]
    return "\n".join(lines) + "\n"


def escaped(words):
    """A text of the man page."""
    words = words.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + words if words.startswith((".", "'")) else words


def pages(text, version):
    """{path in share: content}."""
    options = options_of(text)
    return {"bash-completion/completions/gfb": bash(options), "zsh/site-functions/_gfb": zsh(options),
            "fish/vendor_completions.d/gfb.fish": fish(options), "man/man1/gfb.1": man(text, version)}
