/* What was written, for people: said once, after everything else that a command prints. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>

static const char page[] = "report.html"; /* is named first */

static bool has_page(const sp_output *output)
{
    bool has = false;
    for (size_t i = 0; i < sp_output_count(output); i++)
        has = has || !strcmp(sp_output_name(output, i), page);
    return has;
}

/* "wrote FOLDER: report.html, result.json", without the folder where that is the working directory; NULL where memory
 * runs out. */
static char *list_files(const sp_output *output, const char *folder)
{
    bool here = !strcmp(folder, ".");
    size_t size = strlen(folder) + sizeof "wrote : " + sizeof page + 2;
    for (size_t i = 0; i < sp_output_count(output); i++)
        size += strlen(sp_output_name(output, i)) + 2;
    char *text = malloc(size);
    if (!text)
        return NULL;
    char *at = text + sprintf(text, "wrote %s%s%s", here ? "" : folder, here ? "" : ": ", has_page(output) ? page : "");
    bool first = !has_page(output);
    for (size_t i = 0; i < sp_output_count(output); i++) {
        const char *name = sp_output_name(output, i);
        if (strcmp(name, page) != 0) {
            at += sprintf(at, "%s%s", first ? "" : ", ", name);
            first = false;
        }
    }
    return text;
}

bool cli_commit(sp_output *output, const char *folder, char **written, sp_error *error)
{
    *written = list_files(output, folder);
    if (!*written) {
        sp_output_discard(output);
        return sp_fail_memory(error);
    }
    if (sp_output_commit(output, error))
        return true;
    free(*written);
    *written = NULL;
    return false;
}

void cli_say_written(const cli_options *options, const char *written)
{
    if (options->quiet)
        return;
    if (written)
        fprintf(options->json ? stderr : stdout, "%s%s\n", options->json ? "sprayplan: " : "\n", written);
    else if (!options->json) {
        fflush(stdout);
        fprintf(stderr, "sprayplan: nothing was written; -o DIR says where to\n");
    }
}
