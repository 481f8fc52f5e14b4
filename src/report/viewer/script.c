#include "script.h"

/* The assembler takes the files in, so that nothing is generated. */
#ifdef __APPLE__
#define SECTION ".const_data"
#define SYMBOL(name) "_" name
#else
#define SECTION ".section .rodata"
#define SYMBOL(name) name
#endif
#define EMBED(name, file)                                                                                              \
    __asm__(SECTION "\n.globl " SYMBOL(name) "\n" SYMBOL(name) ":\n.incbin \"" file "\"\n.globl " SYMBOL(              \
        name "_end") "\n" SYMBOL(name "_end") ":\n.byte 0\n.text\n")

EMBED("sp_viewer_script", SPRAYPLAN_VIEWER "/viewer.js");
EMBED("sp_surface_script", SPRAYPLAN_VIEWER "/surface.js");
EMBED("sp_geometry_script", SPRAYPLAN_VIEWER "/geometry.js");
EMBED("sp_live_script", SPRAYPLAN_VIEWER "/live.js");
EMBED("sp_live_worker", SPRAYPLAN_VIEWER "/worker.js");
#ifdef SPRAYPLAN_LIVE
EMBED("sp_live_module", SPRAYPLAN_LIVE);
const bool sp_live_is_built = true;
#else
const char sp_live_module[] = "", sp_live_module_end[] = "";
const bool sp_live_is_built = false;
#endif
EMBED("sp_viewer_style", SPRAYPLAN_VIEWER "/viewer.css");
