#ifndef MESH_CAD_OCCT_SOUNDNESS_H
#define MESH_CAD_OCCT_SOUNDNESS_H

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_WorkSession.hxx>

#include <string>
#include <vector>

/* What was made of a STEP file and cannot be right, a text each: solids that fell apart, and faces that cross
 * themselves or are bounded wrong. */
std::vector<std::string> sp_cad_flaws(const Handle(XSControl_WorkSession) & session);

/* Whether a face's triangles, cut with neighbours that turn by `angle` at most, have its area. `text`, if not, says
 * so; `unit` is m of OpenCASCADE's lengths. */
bool sp_cad_keeps_area(const TopoDS_Face &face, double angle, double least, double unit, std::string &text);

#endif
