/* The viewer's script and style as they lie in this folder. */
#ifndef REPORT_VIEWER_SCRIPT_H
#define REPORT_VIEWER_SCRIPT_H

extern const char sp_viewer_script[], sp_viewer_script_end[];
extern const char sp_viewer_style[], sp_viewer_style_end[];

#endif
