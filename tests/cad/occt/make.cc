/* Makes the CAD files of the tests through OpenCASCADE: make-cad
 * vessel|altered|round|ball|head|bars FILE [UNIT, COUNT or DEGREES]. */
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom_Ellipse.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace
{

// mm
const double RADIUS = 500, HEIGHT = 1000, WALL = 5, SHAFT = 20, SHAFT_END = 100, PIPE = 50, NOZZLE_END = 700;
const double BLADE[3] = {300, 10, 87};

Handle(XCAFDoc_ShapeTool) shapes;

TDF_Label product(const TopoDS_Shape &shape, const char *name)
{
    TDF_Label label = shape.IsNull() ? shapes->NewShape() : shapes->AddShape(shape, Standard_False);
    TDataStd_Name::Set(label, name);
    return label;
}

gp_Trsf moved(double x, double y, double z)
{
    gp_Trsf move;
    move.SetTranslation(gp_Vec(x, y, z));
    return move;
}

gp_Trsf turned(double degrees)
{
    gp_Trsf turn;
    turn.SetRotation(gp::OZ(), degrees * M_PI / 180);
    return turn;
}

void copy(const TDF_Label &assembly, const TDF_Label &original, const gp_Trsf &where, const char *name)
{
    TDF_Label label = shapes->AddComponent(assembly, original, TopLoc_Location(where));
    TDataStd_Name::Set(label, name);
}

TopoDS_Edge arc(double radius)
{
    gp_Pnt from(0, 0, -radius), to(radius, 0, 0), middle(radius * std::sqrt(0.5), 0, -radius * std::sqrt(0.5));
    return BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, middle, to).Value());
}

TopoDS_Edge line(double x0, double z0, double x1, double z1)
{
    return BRepBuilderAPI_MakeEdge(gp_Pnt(x0, 0, z0), gp_Pnt(x1, 0, z1));
}

/* A wall below a lid: cylinder and hemisphere. */
TopoDS_Shape shell()
{
    double outer = RADIUS + WALL;
    BRepBuilderAPI_MakeWire wire;
    wire.Add(arc(RADIUS));
    wire.Add(line(RADIUS, 0, RADIUS, HEIGHT));
    wire.Add(line(RADIUS, HEIGHT, outer, HEIGHT));
    wire.Add(line(outer, HEIGHT, outer, 0));
    wire.Add(arc(outer));
    wire.Add(line(0, -outer, 0, -RADIUS));
    return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ()).Shape();
}

/* Everything is made about an origin of its own and put into place on two levels. Altered: the lid lies 1 mm deep in
 * the shell, and the blades beside the shaft's axis with half their thickness in it. */
void vessel(bool altered)
{
    TDF_Label whole = product(TopoDS_Shape(), "vessel"), agitator = product(TopoDS_Shape(), "agitator");
    TDF_Label blade =
        product(BRepPrimAPI_MakeBox(gp_Pnt(-BLADE[0] / 2, -BLADE[1] / 2, 0), BLADE[0], BLADE[1], BLADE[2]), "blade");
    TDF_Label shaft = product(BRepPrimAPI_MakeCylinder(SHAFT, HEIGHT + WALL / 2 - SHAFT_END), "shaft");
    TDF_Label foot = product(BRepPrimAPI_MakeCylinder(30, 400), "foot");
    double beside = altered ? SHAFT : 0;
    copy(agitator, shaft, turned(10), "shaft");
    copy(agitator, blade, moved(0, beside, 50), "blade");
    copy(agitator, blade, turned(90) * moved(0, beside, 350), "blade");
    copy(whole, product(shell(), "shell"), turned(33), "shell");
    copy(whole, product(BRepPrimAPI_MakeCylinder(RADIUS + WALL, WALL), "lid"), moved(0, 0, HEIGHT - altered), "lid");
    copy(whole, agitator, moved(0, 0, SHAFT_END) * turned(25), "agitator");
    for (int i = 0; i < 3; i++)
        copy(whole, foot, turned(120 * i) * moved(600, 0, -400), "");
}

/* The cylinder and the hemisphere whose area and volume are known. */
void round()
{
    gp_Ax2 away(gp_Pnt(2000, 0, 0), gp::DZ());
    product(BRepPrimAPI_MakeCylinder(RADIUS, HEIGHT), "cylinder");
    product(BRepPrimAPI_MakeSphere(away, RADIUS, -M_PI / 2, 0.0), "hemisphere");
}

/* What is within `outer` and a pipe, but not within `inner` and the pipe's bore. */
TopoDS_Shape with_nozzle(const TopoDS_Shape &outer, const TopoDS_Shape &inner, const gp_Ax2 &nozzle, double length)
{
    TopoDS_Shape pipe = BRepPrimAPI_MakeCylinder(nozzle, PIPE, length),
                 bore = BRepPrimAPI_MakeCylinder(nozzle, PIPE - WALL, length - WALL);
    return BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(outer, pipe), BRepAlgoAPI_Fuse(inner, bore));
}

/* A hollow sphere with a shut nozzle across its seam. */
void ball()
{
    product(with_nozzle(BRepPrimAPI_MakeSphere(RADIUS), BRepPrimAPI_MakeSphere(RADIUS - WALL),
                        gp_Ax2(gp_Pnt(0, 0, 0), gp::DX()), NOZZLE_END),
            "ball");
}

/* A head that is half as high as wide, as an ellipse turned about its own axis, on a flat floor. */
TopoDS_Shape head(double radius)
{
    Handle(Geom_Ellipse) ellipse = new Geom_Ellipse(gp_Ax2(gp_Pnt(0, 0, 0), -gp::DY(), gp::DX()), radius, radius / 2);
    BRepBuilderAPI_MakeWire wire;
    wire.Add(line(0, 0, radius, 0));
    wire.Add(BRepBuilderAPI_MakeEdge(ellipse, gp_Pnt(radius, 0, 0), gp_Pnt(0, 0, radius / 2)).Edge());
    wire.Add(line(0, radius / 2, 0, 0));
    return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ()).Shape();
}

/* Hollow, with a shut nozzle so far round from its seam. */
void hollow_head(double degrees)
{
    gp_Ax2 nozzle = gp_Ax2(gp_Pnt(200, 0, 100), gp::DZ()).Transformed(turned(degrees));
    gp_Trsf above = moved(0, 0, WALL);
    product(with_nozzle(head(RADIUS), head(RADIUS - 2 * WALL).Moved(above), nozzle, 300), "head");
}

/* Many bars of three faces each, fifty in a row. */
void bars(int count)
{
    TDF_Label whole = product(TopoDS_Shape(), "rack"), row;
    for (int i = 0; i < count; i++) {
        if (i % 50 == 0) {
            row = product(TopoDS_Shape(), "row");
            copy(whole, row, moved(0, 0, 100 * (i / 50)), "row");
        }
        TopoDS_Shape bar = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp::DY()), 10 + i % 7, 400 + i % 11);
        copy(row, product(bar, "bar"), moved(50 * (i % 50), 0, 0), "bar");
    }
}

bool write(const Handle(TDocStd_Document) & document, const char *file, const char *unit)
{
    const char *dot = strrchr(file, '.');
    Interface_Static::SetCVal("write.step.unit", unit);
    Interface_Static::SetCVal("write.iges.unit", unit);
    shapes->UpdateAssemblies();
    if (dot && strcmp(dot, ".step") == 0) {
        STEPCAFControl_Writer writer;
        return writer.Transfer(document) && writer.Write(file) == IFSelect_RetDone;
    }
    TDF_LabelSequence free;
    shapes->GetFreeShapes(free);
    TopoDS_Compound one;
    BRep_Builder builder;
    builder.MakeCompound(one);
    for (int i = 1; i <= free.Length(); i++)
        builder.Add(one, XCAFDoc_ShapeTool::GetShape(free.Value(i)));
    if (dot && strcmp(dot, ".brep") == 0)
        return BRepTools::Write(one, file);
    IGESControl_Writer writer(unit, 0); // faces, not solids
    return writer.AddShape(one) && writer.Write(file);
}

} // namespace

int main(int count, char **arguments)
{
    std::string what = count > 2 ? arguments[1] : "", last = count > 3 ? arguments[3] : "MM";
    Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
    STEPCAFControl_Writer ready; // the settings are there once a writer is
    IGESControl_Writer ready_too;
    shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    if (what == "vessel" || what == "altered")
        vessel(what == "altered");
    else if (what == "round")
        round();
    else if (what == "ball")
        ball();
    else if (what == "head")
        hollow_head(atof(last.c_str()));
    else if (what == "bars")
        bars(atoi(last.c_str()));
    else
        return 2;
    return write(document, arguments[2], what == "bars" || what == "head" ? "MM" : last.c_str()) ? 0 : 1;
}
