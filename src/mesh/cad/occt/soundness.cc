/* OpenCASCADE tells of no fault where it took the wrong side of a closed surface, or lost a boundary: what comes of it
 * is checked. */
#include "soundness.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Poly_Triangulation.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <TopExp_Explorer.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>

#include <cmath>
#include <cstdio>

namespace
{

const double AREA_SHARE = 0.02;

double triangles_area(const Handle(Poly_Triangulation) & triangles)
{
    double area = 0;
    for (int i = 1; i <= triangles->NbTriangles(); i++) {
        int corners[3];
        triangles->Triangle(i).Get(corners[0], corners[1], corners[2]);
        gp_Pnt first = triangles->Node(corners[0]);
        area +=
            gp_Vec(first, triangles->Node(corners[1])).CrossMagnitude(gp_Vec(first, triangles->Node(corners[2]))) / 2;
    }
    return area;
}

} // namespace

std::vector<std::string> sp_cad_flaws(const Handle(XSControl_WorkSession) & session)
{
    std::vector<std::string> flaws;
    Handle(Interface_InterfaceModel) model = session->Model();
    Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
    for (int i = 1; i <= model->NbEntities(); i++) {
        if (!model->Value(i)->IsKind(STANDARD_TYPE(StepShape_ManifoldSolidBrep)))
            continue;
        TopoDS_Shape shape = TransferBRep::ShapeResult(process, model->Value(i));
        int solids = 0;
        for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next())
            solids++;
        std::string entity = "entity " + std::to_string(i) + ": ";
        if (!shape.IsNull() && solids != 1)
            flaws.push_back(entity + "a solid became " + std::to_string(solids) + " bodies");
        else if (!shape.IsNull() && !BRepCheck_Analyzer(shape).IsValid())
            flaws.push_back(entity + "a solid's faces are bounded wrong");
    }
    return flaws;
}

/* Along a curved face two edges of triangles turn by twice the angle at most, each way. */
bool sp_cad_keeps_area(const TopoDS_Face &face, double angle, double least, double unit, std::string &text)
{
    TopLoc_Location within;
    GProp_GProps exact;
    BRepGProp::SurfaceProperties(face, exact);
    double area = std::fabs(exact.Mass()), cut = triangles_area(BRep_Tool::Triangulation(face, within)),
           flat = 1 - std::sin(std::fmin(angle, M_PI)) / angle;
    if (std::fabs(cut - area) < (AREA_SHARE + 2 * flat) * area + least)
        return true;
    char numbers[120];
    snprintf(numbers, sizeof numbers, "a face of %.4g m2 whose triangles have %.4g m2", area * unit * unit,
             cut * unit * unit);
    text = numbers;
    return false;
}
