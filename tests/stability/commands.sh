# For scripts that let other compilers, or other headers, read what a build compiles.

# commands WORK, in a build: what it compiles for library, program and modules, a file once, one command a line without
# compiler, output and the compiler's own options; left out is what it compiled for the report's page. WORK is a folder
# for what is in between.
commands() {
    { echo none && find src/live -name '*.o' | sed 's,.*/\(.*\)\.o$,\1,'; } >"$1/page"
    sed -n 's/^ *"command": "\(.*\)",\{0,1\}$/\1/p' compile_commands.json | sed 's/\\\(.\)/\1/g' |
        grep -E " -c $source/(src|optimizer)/[^ ]*\$" |
        awk -v from="^$source/src/" 'NR == FNR {page[$0]; next}
            {name = $NF; sub(from, "", name); gsub("/", "-", name)} !(name in page) && !seen[$NF]++' "$1/page" - |
        sed -E "s,^([^ ]*ccache )?[^ ]+ (.*) -o [^ ]+ -c ([^ ]+)\$,\2 \3,"
}
