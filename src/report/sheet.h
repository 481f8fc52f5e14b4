/* Sheets of all designs: what to weld, set and order. */
#ifndef REPORT_SHEET_H
#define REPORT_SHEET_H

#include <sprayplan/report.h>

#define SP_ALL_NOZZLES "nozzles-all.csv"

/* [result->design_count], NULL of a design without an evaluator. NULL on error.
 * For sp_fitting_sheets_destroy, which accepts NULL. */
sp_fitting_sheet **sp_fitting_sheets_of(const sp_result *result, sp_error *error);
void sp_fitting_sheets_destroy(sp_fitting_sheet **sheets, size_t count);

#endif
