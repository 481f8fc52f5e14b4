# To be sourced at the project's root: ids, and by id file, edit, tests and says, as tests/mutants/list has them.
declare -A file edit tests says
ids=()
while read -r key value; do
    case "$key" in
    '' | '#'*) ;;
    mutant) id=$value ids+=("$value") ;;
    file) file[$id]=$value ;;
    sed) edit[$id]=$value ;;
    tests) tests[$id]=$value ;;
    says) says[$id]=$value ;;
    *) echo "tests/mutants/list: what is $key?" >&2 && exit 2 ;;
    esac
done <tests/mutants/list
