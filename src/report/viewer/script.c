#include "script.h"

/* The assembler takes the files in, so that nothing is generated; OWN is a symbol of the library alone. */
#ifdef __APPLE__
#define SECTION ".const_data"
#define OWN(name) ".private_extern _" name "\n.globl _" name "\n_" name ":\n"
#else
#define SECTION ".section .rodata"
#define OWN(name) ".hidden " name "\n.globl " name "\n" name ":\n"
#endif
/* `files`: one after the other. */
#define EMBED(name, files) __asm__(SECTION "\n" OWN(name) files OWN(name "_end") ".byte 0\n.text\n")
#define TAKEN(path) ".incbin \"" path "\"\n"
#define VIEWER(file) TAKEN(SPRAYPLAN_VIEWER "/" file)
#define LIVE(file) TAKEN(SPRAYPLAN_VIEWER "/live/" file)

/* The last of each puts together what is in those before it. */
EMBED("sp_viewer_script",
      VIEWER("geometry.js") VIEWER("scrolling.js") VIEWER("coder.js") VIEWER("triangle_order.js")
          VIEWER("vertex_code.js") VIEWER("unfolded.js") VIEWER("exact.js") VIEWER("patch_code.js") VIEWER("surface.js")
              VIEWER("sprays.js") VIEWER("charts.js") VIEWER("data.js") VIEWER("widgets.js") VIEWER("scales.js")
                  VIEWER("colours.js") VIEWER("camera.js") VIEWER("shaders.js") VIEWER("upload.js") VIEWER("drawing.js")
                      VIEWER("pick.js") VIEWER("labels.js") VIEWER("axes.js") VIEWER("choosing.js") VIEWER("bar.js")
                          VIEWER("controls.js") VIEWER("layers.js") VIEWER("pointer.js") VIEWER("keyboard.js")
                              VIEWER("viewer.js"));
EMBED("sp_live_script",
      LIVE("evaluator.js") LIVE("layout.js") LIVE("telling.js") LIVE("evaluating.js") LIVE("scene.js")
          LIVE("changes.js") LIVE("sliders.js") LIVE("controls.js") LIVE("handles.js") LIVE("live.js"));
EMBED("sp_live_loader", LIVE("load.js"));
EMBED("sp_live_worker", LIVE("worker.js"));
#ifdef SPRAYPLAN_LIVE
EMBED("sp_live_module", TAKEN(SPRAYPLAN_LIVE));
const bool sp_live_is_built = true;
#else
const char sp_live_module[] = "", sp_live_module_end[] = "";
const bool sp_live_is_built = false;
#endif
EMBED("sp_viewer_style", VIEWER("viewer.css"));
