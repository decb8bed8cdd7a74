# Completion of menger and its programs in bash: commands, options as --help prints them, starting points, and files by their kind.

# Options of a program and command: words of its help that begin with two hyphens.
_menger_options() { "$@" --help 2>/dev/null | grep -oE '(^|[ ,])--[a-z][a-z-]*' | tr -d ' ,' | sort -u; }

_menger() {
  local cur prev words cword
  _init_completion || return
  local call=("${words[0]}")
  if [[ ${words[0]##*/} == menger ]]; then
    if ((cword == 1)); then
      mapfile -t COMPREPLY < <(compgen -W "$("${words[0]}" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z-]*\)  .*/\1/p') --help --version" -- "$cur")
      return
    fi
    call+=("${words[1]}")
  fi
  local command=${call[-1]##*/}
  command=${command#menger-}
  if [[ $cur == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_menger_options "${call[@]}")" -- "$cur")
  elif [[ $command == init && $prev == --from ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("${call[@]}" --list 2>/dev/null | sed -n 's/^ *\([a-z_][a-z_]*\) .*/\1/p')" -- "$cur")
  else
    case $command in
      export | confirm | reevaluate) _filedir '@(sqlite|toml)' ;;
      report | compare-searches) _filedir -d ;;
      fit) _filedir '@(csv|toml)' ;;
      *) _filedir toml ;;
    esac
  fi
}

complete -F _menger menger menger-{calibrate,compare-searches,confirm,evolve,export,extremes,fit,inflate,init,load-cases,locomote,loop,mesh,modes,reevaluate,report,simulate,stall-map,tradeoff,validate}
