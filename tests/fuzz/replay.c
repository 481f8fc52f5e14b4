/* Feeds a target with each file of a folder: whole, cut at every length, and with each bit flipped, or as many of them
 * as there is time for. A file whose name begins with "bad" must be refused, any other accepted. */
#include "target.h"

#include <dirent.h>
#include <signal.h>
#include <unistd.h>

enum {
    MOST_FLIPS = 4000, /* of a seed */
    HANG = 60          /* s, of one input; most take less than a millisecond */
};

/* What is being tried, for whoever reads that it failed. */
static char trying[512];

static void tell(int signal)
{
    (void)signal;
    fprintf(stderr, "with %s\n", trying);
    _Exit(1);
}

static void try(const uint8_t *data, size_t size)
{
    uint8_t *own = malloc(size + !size); /* so that a sanitizer sees what lies beyond */
    REQUIRE(own);
    memcpy(own, data, size);
    alarm(HANG);
    LLVMFuzzerTestOneInput(own, size);
    free(own);
}

/* Steele, Lea and Flood's splitmix64. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

static void try_variants(const char *path, uint8_t *data, size_t size)
{
    for (size_t length = 0; length < size; length++) {
        snprintf(trying, sizeof trying, "%s cut at %zu", path, length);
        try(data, length);
    }
    uint64_t random = 1;
    size_t bits = 8 * size, flips = bits < MOST_FLIPS ? bits : MOST_FLIPS;
    for (size_t i = 0; i < flips; i++) {
        size_t bit = bits == flips ? i : next(&random) % bits;
        snprintf(trying, sizeof trying, "%s and bit %zu flipped", path, bit);
        data[bit / 8] ^= (uint8_t)(1u << bit % 8);
        try(data, size);
        data[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
}

static void replay(const char *folder, const char *name)
{
    snprintf(trying, sizeof trying, "%s/%s", folder, name);
    FILE *file = fopen(trying, "rb");
    REQUIRE(file && fseek(file, 0, SEEK_END) == 0);
    size_t size = (size_t)ftell(file);
    rewind(file);
    uint8_t *data = malloc(size + !size);
    REQUIRE(data && fread(data, 1, size, file) == size);
    fclose(file);
    char path[sizeof trying];
    memcpy(path, trying, sizeof path);
    try(data, size);
    REQUIRE(target_accepted == (strncmp(name, "bad", 3) != 0));
    try_variants(path, data, size);
    free(data);
}

int main(int count, char **arguments)
{
    REQUIRE(count == 2);
    signal(SIGABRT, tell);
    signal(SIGALRM, tell);
    struct dirent **entries;
    int found = scandir(arguments[1], &entries, NULL, alphasort);
    REQUIRE(found > 2);
    for (int i = 0; i < found; i++) {
        if (entries[i]->d_name[0] != '.')
            replay(arguments[1], entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
    return 0;
}
