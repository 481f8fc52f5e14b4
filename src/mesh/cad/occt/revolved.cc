/* Heads of vessels are often an ellipse turned about its own axis. Turned whole, it passes every place twice, its poles
 * lie amid the surface, and OpenCASCADE loses the edges of what crosses the seam. Half of it is the same surface. */
#include "revolved.h"

#include <StepGeom_Axis1Placement.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_Ellipse.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_SurfaceOfRevolution.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_TrimmingSelect.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Lin.hxx>

namespace
{

const double CLOSE = 1e-6; // of the radius, and rad

/* Of directions and points, as the file has them. */
bool numbers_of(const Handle(StepGeom_CartesianPoint) & point, gp_XYZ &numbers)
{
    if (point.IsNull() || point->NbCoordinates() != 3)
        return false;
    numbers = gp_XYZ(point->CoordinatesValue(1), point->CoordinatesValue(2), point->CoordinatesValue(3));
    return true;
}

bool numbers_of(const Handle(StepGeom_Direction) & direction, gp_XYZ &numbers)
{
    if (direction.IsNull() || direction->NbDirectionRatios() != 3)
        return false;
    numbers = gp_XYZ(direction->DirectionRatiosValue(1), direction->DirectionRatiosValue(2),
                     direction->DirectionRatiosValue(3));
    return numbers.Modulus() > 0;
}

bool axis_of(const Handle(StepGeom_Axis1Placement) & placement, gp_Ax1 &axis)
{
    gp_XYZ at, along;
    if (placement.IsNull() || !numbers_of(placement->Location(), at) || !numbers_of(placement->Axis(), along))
        return false;
    axis = gp_Ax1(gp_Pnt(at), gp_Dir(along));
    return true;
}

bool frame_of(const Handle(StepGeom_Conic) & conic, gp_Ax2 &frame)
{
    gp_XYZ at, normal, across;
    Handle(StepGeom_Axis2Placement3d) placement = conic->Position().Axis2Placement3d();
    if (placement.IsNull() || !numbers_of(placement->Location(), at) || !numbers_of(placement->Axis(), normal) ||
        !numbers_of(placement->RefDirection(), across) || gp_Dir(normal).IsParallel(gp_Dir(across), CLOSE))
        return false;
    frame = gp_Ax2(gp_Pnt(at), gp_Dir(normal), gp_Dir(across));
    return true;
}

/* From its middle to the pole where its half begins; false where it is not turned about an axis of its own. */
bool pole_of(const Handle(StepGeom_Conic) & conic, const gp_Ax2 &frame, const gp_Ax1 &axis, gp_Vec &pole)
{
    Handle(StepGeom_Circle) circle = Handle(StepGeom_Circle)::DownCast(conic);
    Handle(StepGeom_Ellipse) ellipse = Handle(StepGeom_Ellipse)::DownCast(conic);
    if (circle.IsNull() && ellipse.IsNull())
        return false;
    double x = ellipse.IsNull() ? circle->Radius() : ellipse->SemiAxis1(),
           y = ellipse.IsNull() ? circle->Radius() : ellipse->SemiAxis2();
    if (gp_Lin(axis).Distance(frame.Location()) > CLOSE * x)
        return false;
    bool along_y = frame.YDirection().IsParallel(axis.Direction(), CLOSE);
    pole = along_y ? gp_Vec(frame.YDirection()) * -y : gp_Vec(frame.XDirection()) * x;
    return along_y || frame.XDirection().IsParallel(axis.Direction(), CLOSE);
}

Handle(StepGeom_HArray1OfTrimmingSelect) end_at(const gp_Pnt &point)
{
    Handle(TColStd_HArray1OfReal) numbers = new TColStd_HArray1OfReal(1, 3);
    for (int k = 1; k <= 3; k++)
        numbers->SetValue(k, point.Coord(k));
    Handle(StepGeom_CartesianPoint) end = new StepGeom_CartesianPoint;
    end->Init(new TCollection_HAsciiString(""), numbers);
    StepGeom_TrimmingSelect select;
    select.SetValue(end);
    Handle(StepGeom_HArray1OfTrimmingSelect) ends = new StepGeom_HArray1OfTrimmingSelect(1, 1);
    ends->SetValue(1, select);
    return ends;
}

} // namespace

void sp_cad_halve_revolved(const Handle(Interface_InterfaceModel) & model)
{
    for (int i = 1; i <= model->NbEntities(); i++) {
        gp_Ax1 axis;
        gp_Ax2 frame;
        gp_Vec pole;
        Handle(StepGeom_SurfaceOfRevolution) surface = Handle(StepGeom_SurfaceOfRevolution)::DownCast(model->Value(i));
        if (surface.IsNull())
            continue;
        Handle(StepGeom_Conic) conic = Handle(StepGeom_Conic)::DownCast(surface->SweptCurve());
        if (conic.IsNull() || !axis_of(surface->AxisPosition(), axis) || !frame_of(conic, frame) ||
            !pole_of(conic, frame, axis, pole))
            continue;
        Handle(StepGeom_TrimmedCurve) half = new StepGeom_TrimmedCurve;
        half->Init(new TCollection_HAsciiString(""), conic, end_at(frame.Location().Translated(pole)),
                   end_at(frame.Location().Translated(-pole)), Standard_True, StepGeom_tpCartesian);
        surface->SetSweptCurve(half);
    }
}
