#include "ranks/messages.h"

#include "module/module.h"
#include "ranks/mpi/module.h"

#include <stdlib.h>
#include <string.h>

/* With what every call begins: what each rank is about to do. Where one has failed, or does something else than the
 * others, all know it here, and none waits for what will not come. */
typedef struct {
    uint64_t call;  /* what, and the number of the call */
    uint64_t words; /* that will follow */
    uint64_t failed;
    double values[SP_VALUES_MOST];
} notice;

struct sp_ranks {
    const sp_mpi *mpi;
    bool (*ends)(void);
    size_t own, count;
    uint64_t calls;
    notice *notices; /* [count] */
    bool apart;
    bool mute; /* the others do not answer */
    bool over; /* one has failed, which all know */
};

/* A whole number of the environment; `otherwise` where neither is there. */
static long ask_environment(const char *name, const char *other, long otherwise)
{
    const char *text = getenv(name) ? getenv(name) : getenv(other);
    return text ? strtol(text, NULL, 10) : otherwise;
}

bool sp_ranks_first(void)
{
    return ask_environment("OMPI_COMM_WORLD_RANK", "PMI_RANK", 0) == 0;
}

static const sp_mpi *find_mpi(long count, sp_error *error)
{
    static sp_module module = {.file = "sprayplan-mpi.so", .name = "sp_mpi_module"};
    sp_error missing = {0};
    sp_module_function *found = sp_module_open(&module, &missing);
    if (found)
        return ((__typeof__(sp_mpi_module) *)found)();
    sp_fail(error, missing.kind, NULL, 0, 0,
            "%ld processes were started to work together, for which sprayplan has to be built where MPI is (on Debian: "
            "libopenmpi-dev): %s",
            count, missing.message);
    return NULL;
}

bool sp_ranks_join(bool (*ends)(void), sp_ranks **ranks, sp_error *error)
{
    long started = ask_environment("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", 1);
    *ranks = NULL;
    if (started <= 1)
        return true;
    const sp_mpi *mpi = find_mpi(started, error);
    if (!mpi)
        return false;
    sp_ranks *joined = calloc(1, sizeof *joined);
    if (!joined)
        return sp_fail_memory(error);
    joined->mpi = mpi;
    joined->ends = ends;
    mpi->start(&joined->own, &joined->count);
    joined->notices = calloc(joined->count, sizeof *joined->notices);
    if (!joined->notices) {
        free(joined);
        return sp_fail_memory(error);
    }
    *ranks = joined;
    return true;
}

bool sp_ranks_lost(const sp_ranks *ranks)
{
    return ranks && (ranks->mute || ranks->over);
}

size_t sp_ranks_count(const sp_ranks *ranks)
{
    return ranks && !sp_ranks_lost(ranks) ? ranks->count : 1;
}

size_t sp_ranks_own(const sp_ranks *ranks)
{
    return ranks && !sp_ranks_lost(ranks) ? ranks->own : 0;
}

void sp_ranks_part(sp_ranks *ranks)
{
    if (ranks)
        ranks->apart = true;
}

void sp_ranks_rejoin(sp_ranks *ranks)
{
    if (ranks)
        ranks->apart = false;
}

bool sp_ranks_apart(const sp_ranks *ranks)
{
    return ranks && ranks->apart;
}

/* FNV-1a: Fowler, Noll and Vo. */
static uint64_t name_call(const char *what, uint64_t number)
{
    uint64_t hash = 0xcbf29ce484222325;
    for (; *what; what++)
        hash = (hash ^ (unsigned char)*what) * 0x100000001b3;
    return hash ^ number;
}

/* The first goes on alone, the others have nothing to go on for. */
static bool lose(const sp_ranks *ranks, sp_error *error)
{
    return ranks->own == 0 || sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "the other ranks do not answer");
}

/* Sends a notice and reads those of all. */
static bool call_roll(sp_ranks *ranks, const notice *own, sp_error *error)
{
    ranks->mute = !ranks->mpi->gather(own, sizeof *own, ranks->notices, ranks->ends);
    bool apart = false;
    for (size_t i = 0; !ranks->mute && i < ranks->count; i++) {
        ranks->over |= ranks->notices[i].failed > 0;
        apart |= ranks->notices[i].call != own->call;
    }
    if (sp_ranks_lost(ranks))
        return lose(ranks, error);
    ranks->over = apart;
    return !apart || sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                             "the ranks have come apart: they have to read the same scene by the same program, on "
                             "machines of one kind");
}

bool sp_ranks_highest(sp_ranks *ranks, const char *what, double *values, size_t count, sp_error *error)
{
    if (sp_ranks_count(ranks) == 1)
        return true;
    notice own = {.call = name_call(what, ranks->calls++)};
    memcpy(own.values, values, count * sizeof *values);
    if (!call_roll(ranks, &own, error))
        return false;
    for (size_t i = 0; !sp_ranks_lost(ranks) && i < ranks->count; i++)
        for (size_t k = 0; k < count; k++)
            if (ranks->notices[i].values[k] > values[k])
                values[k] = ranks->notices[i].values[k];
    return true;
}

bool sp_ranks_any(sp_ranks *ranks, bool own)
{
    double value = own;
    return !sp_ranks_highest(ranks, "any", &value, 1, NULL) || value > 0;
}

bool sp_ranks_fail(sp_ranks *ranks)
{
    if (ranks && !sp_ranks_lost(ranks))
        call_roll(ranks, &(notice){.failed = 1}, NULL);
    else
        return !ranks || ranks->own == 0;
    for (size_t i = 0; !ranks->mute && i < ranks->own; i++)
        if (ranks->notices[i].failed)
            return false;
    return true;
}

void sp_ranks_leave(sp_ranks *ranks)
{
    if (!ranks)
        return;
    /* whoever has nothing left to do sleeps here while the first writes, also when it has been asked to end */
    ranks->ends = NULL;
    if (!sp_ranks_lost(ranks))
        call_roll(ranks, &(notice){.call = name_call("leave", 0)}, NULL);
    if (!ranks->mute)
        ranks->mpi->finish();
    free(ranks->notices);
    free(ranks);
}

/* After the roll all wait for what was announced: whoever has no memory for it cannot say so any more. */
static void give_up(const sp_ranks *ranks)
{
    ranks->mpi->abandon(1);
}

/* What all have announced, by word. */
static bool receive(sp_ranks *ranks, const sp_outgoing *outgoing, sp_gathered *gathered, sp_error *error)
{
    size_t words = 0, *counts = malloc(ranks->count * sizeof *counts);
    gathered->at = malloc(2 * ranks->count * sizeof *gathered->at);
    for (size_t i = 0; counts && gathered->at && i < ranks->count; i++) {
        counts[i] = (size_t)ranks->notices[i].words;
        gathered->at[i] = 8 * words;
        words += counts[i];
        gathered->at[ranks->count + i] = 8 * words;
    }
    gathered->bytes = malloc(8 * words + 8);
    if (!counts || !gathered->at || !gathered->bytes)
        give_up(ranks);
    gathered->end = gathered->at + ranks->count;
    bool there = !words || ranks->mpi->gather_words((const uint64_t *)(const void *)outgoing->bytes, counts,
                                                    (uint64_t *)(void *)gathered->bytes, ranks->ends);
    free(counts);
    if (there) {
        gathered->count = ranks->count;
        return true;
    }
    sp_gathered_free(gathered);
    ranks->mute = true;
    return lose(ranks, error);
}

bool sp_ranks_gather(sp_ranks *ranks, const char *what, sp_outgoing *outgoing, sp_gathered *gathered, sp_error *error)
{
    *gathered = (sp_gathered){0};
    bool done = true;
    if (sp_ranks_count(ranks) > 1) {
        static const unsigned char padding[8] = {0};
        sp_pack(outgoing, padding, (8 - outgoing->count % 8) % 8);
        done = !outgoing->lacks_memory || sp_fail_memory(error);
        done =
            done &&
            call_roll(ranks, &(notice){.call = name_call(what, ranks->calls++), .words = outgoing->count / 8}, error);
        done = done && (sp_ranks_lost(ranks) || receive(ranks, outgoing, gathered, error));
    }
    sp_outgoing_free(outgoing);
    return done;
}
