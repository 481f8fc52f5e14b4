/* As-rigid-as-possible flattening, local and global step in turn: L. Liu, L. Zhang, Y. Xu, C. Gotsman and S. J.
 * Gortler, "A Local/Global Approach to Mesh Parameterization" (2008). The global step, a sparse linear system, is
 * carried some way by conjugate gradients with the diagonal as preconditioner; from one round to the next little is
 * left to do. */
#include "atlas/charts/relax.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool reserve(sp_relaxer *r, size_t count)
{
    if (count <= r->capacity)
        return true;
    sp_relaxer_destroy(r);
    count += count / 2;
    r->residual = malloc(count * sizeof *r->residual);
    r->move = malloc(count * sizeof *r->move);
    r->search = malloc(count * sizeof *r->search);
    r->image = malloc(count * sizeof *r->image);
    r->diagonal = malloc(count * sizeof *r->diagonal);
    if (!r->residual || !r->move || !r->search || !r->image || !r->diagonal) {
        sp_relaxer_destroy(r);
        return false;
    }
    r->capacity = count;
    return true;
}

void sp_relaxer_destroy(sp_relaxer *r)
{
    free(r->residual);
    free(r->move);
    free(r->search);
    free(r->image);
    free(r->diagonal);
    *r = (sp_relaxer){0};
}

/* The inverse of the diagonal of the Laplacian. */
static void find_diagonal(sp_relaxer *r, const sp_sheets *sheets, const sp_sheet *sheet)
{
    for (size_t v = 0; v < sheet->vertex_count; v++)
        r->diagonal[v] = 0;
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        const float *w = sheets->weight[sheet->triangle[i]];
        const uint32_t *c = sheet->corner[i];
        r->diagonal[c[0]] += (double)w[0] + w[2];
        r->diagonal[c[1]] += (double)w[0] + w[1];
        r->diagonal[c[2]] += (double)w[1] + w[2];
    }
    for (size_t v = 0; v < sheet->vertex_count; v++)
        r->diagonal[v] = r->diagonal[v] > 1e-9 ? 1 / r->diagonal[v] : 1;
}

/* Local step: turns each triangle's own shape as it lies best, and sums up how far its edges are from that. */
static void find_residual(sp_relaxer *r, const sp_sheets *sheets, const sp_sheet *sheet)
{
    memset(r->residual, 0, sheet->vertex_count * sizeof *r->residual);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        const double *shape = sheets->shape[sheet->triangle[i]];
        const float *w = sheets->weight[sheet->triangle[i]];
        const uint32_t *c = sheet->corner[i];
        const double *p0 = sheet->at[c[0]], *p1 = sheet->at[c[1]], *p2 = sheet->at[c[2]];
        double ux0 = p1[0] - p0[0], uy0 = p1[1] - p0[1], ux1 = p2[0] - p1[0], uy1 = p2[1] - p1[1];
        double ux2 = p0[0] - p2[0], uy2 = p0[1] - p2[1];
        double ex1 = shape[1] - shape[0], ex2 = -shape[1];
        /* The rotation nearest to Σ w u eᵀ, in closed form. */
        double cosine =
            w[0] * ux0 * shape[0] + w[1] * (ux1 * ex1 + uy1 * shape[2]) + w[2] * (ux2 * ex2 - uy2 * shape[2]);
        double sine = w[0] * uy0 * shape[0] + w[1] * (uy1 * ex1 - ux1 * shape[2]) + w[2] * (uy2 * ex2 + ux2 * shape[2]);
        double length = sqrt(cosine * cosine + sine * sine);
        double inverse = length > 0 ? 1 / length : 0;
        cosine *= inverse;
        sine *= inverse;
        double fx0 = w[0] * (cosine * shape[0] - ux0), fy0 = w[0] * (sine * shape[0] - uy0);
        double fx1 = w[1] * (cosine * ex1 - sine * shape[2] - ux1), fy1 = w[1] * (sine * ex1 + cosine * shape[2] - uy1);
        double fx2 = w[2] * (cosine * ex2 + sine * shape[2] - ux2), fy2 = w[2] * (sine * ex2 - cosine * shape[2] - uy2);
        r->residual[c[0]][0] += fx2 - fx0;
        r->residual[c[0]][1] += fy2 - fy0;
        r->residual[c[1]][0] += fx0 - fx1;
        r->residual[c[1]][1] += fy0 - fy1;
        r->residual[c[2]][0] += fx1 - fx2;
        r->residual[c[2]][1] += fy1 - fy2;
    }
}

/* image = Laplacian × search */
static void apply(sp_relaxer *r, const sp_sheets *sheets, const sp_sheet *sheet)
{
    memset(r->image, 0, sheet->vertex_count * sizeof *r->image);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        const float *w = sheets->weight[sheet->triangle[i]];
        const uint32_t *c = sheet->corner[i];
        const double *p0 = r->search[c[0]], *p1 = r->search[c[1]], *p2 = r->search[c[2]];
        double *q0 = r->image[c[0]], *q1 = r->image[c[1]], *q2 = r->image[c[2]];
        for (int k = 0; k < 2; k++) {
            double f0 = w[0] * (p0[k] - p1[k]), f1 = w[1] * (p1[k] - p2[k]), f2 = w[2] * (p2[k] - p0[k]);
            q0[k] += f0 - f2;
            q1[k] += f1 - f0;
            q2[k] += f2 - f1;
        }
    }
}

/* Conjugate gradients on residual = Laplacian × move, both coordinates side by side. */
static void solve(sp_relaxer *r, const sp_sheets *sheets, const sp_sheet *sheet, int steps)
{
    size_t count = sheet->vertex_count;
    double rho[2] = {0, 0}, first[2];
    for (size_t v = 0; v < count; v++)
        for (int k = 0; k < 2; k++) {
            r->move[v][k] = 0;
            r->search[v][k] = r->diagonal[v] * r->residual[v][k];
            rho[k] += r->search[v][k] * r->residual[v][k];
        }
    memcpy(first, rho, sizeof first);
    for (int step = 0; step < steps && (rho[0] > 1e-4 * first[0] || rho[1] > 1e-4 * first[1]); step++) {
        apply(r, sheets, sheet);
        double slope[2] = {0, 0}, next[2] = {0, 0}, alpha[2], beta[2];
        for (size_t v = 0; v < count; v++)
            for (int k = 0; k < 2; k++)
                slope[k] += r->search[v][k] * r->image[v][k];
        for (int k = 0; k < 2; k++)
            alpha[k] = slope[k] > 0 ? rho[k] / slope[k] : 0;
        for (size_t v = 0; v < count; v++)
            for (int k = 0; k < 2; k++) {
                r->move[v][k] += alpha[k] * r->search[v][k];
                r->residual[v][k] -= alpha[k] * r->image[v][k];
                next[k] += r->diagonal[v] * r->residual[v][k] * r->residual[v][k];
            }
        for (int k = 0; k < 2; k++) {
            beta[k] = rho[k] > 0 ? next[k] / rho[k] : 0;
            rho[k] = next[k];
        }
        for (size_t v = 0; v < count; v++)
            for (int k = 0; k < 2; k++)
                r->search[v][k] = r->diagonal[v] * r->residual[v][k] + beta[k] * r->search[v][k];
    }
}

bool sp_relax(sp_relaxer *relaxer, const sp_sheets *sheets, sp_sheet *sheet, int rounds, int inner)
{
    if (!reserve(relaxer, sheet->vertex_count))
        return false;
    find_diagonal(relaxer, sheets, sheet);
    for (int round = 0; round < rounds; round++) {
        find_residual(relaxer, sheets, sheet);
        solve(relaxer, sheets, sheet, inner);
        for (size_t v = 0; v < sheet->vertex_count; v++)
            for (int k = 0; k < 2; k++)
                sheet->at[v][k] += relaxer->move[v][k];
    }
    return true;
}
