/* How far a word is from one that is known: for "expected 'nozzles'" and "did you mean place?". */
#ifndef SCENE_EDIT_DISTANCE_H
#define SCENE_EDIT_DISTANCE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Slips of the pen from one to the other (Levenshtein's distance); SIZE_MAX for more than two, or than the words have
 * letters. */
static inline size_t sp_edit_distance(const char *text, const char *name)
{
    enum { LONGEST = 31 };
    size_t n = strlen(text), m = strlen(name), row[LONGEST + 1];
    if (n > LONGEST || m > LONGEST)
        return SIZE_MAX;
    for (size_t j = 0; j <= m; j++)
        row[j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            size_t least = diagonal + (text[i - 1] != name[j - 1]);
            diagonal = row[j];
            least = row[j] + 1 < least ? row[j] + 1 : least;
            row[j] = row[j - 1] + 1 < least ? row[j - 1] + 1 : least;
        }
    }
    return row[m] <= 2 && row[m] < m && row[m] < n ? row[m] : SIZE_MAX;
}

#endif
