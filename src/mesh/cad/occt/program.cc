/* sprayplan-cad: the triangles of a STEP, IGES or BREP file by OpenCASCADE, written to standard output as records.h
 * says. A program of its own, since OpenCASCADE may crash, hang or eat all memory on a bad file. */
#include "mesh/cad/records.h"

#include "iges_lengths.h"
#include "length_unit.h"
#include "revolved.h"
#include "soundness.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressScope.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <signal.h>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace
{

const double CHORD_SHARE = 1e-3;     // of the diagonal
const double SEWING_SHARE = 1e-5;    // of the diagonal
const double AREA_LEAST = 1e-6;      // of the diagonal's square: a face's triangles may be off by it
const size_t RECORD_VERTICES = 4096; // in a record

FILE *pipe_out;
double unit; // m, of OpenCASCADE's lengths

void put(uint32_t kind, const void *bytes, size_t size)
{
    sp_cad_record record = {kind, (uint32_t)size};
    if (fwrite(&record, sizeof record, 1, pipe_out) != 1 || fwrite(bytes, 1, size, pipe_out) != size)
        _exit(1);
}

void put_text(uint32_t kind, const std::string &before, const char *text)
{
    std::string bytes = before + std::string(text).substr(0, 600);
    put(kind, bytes.data(), bytes.size());
}

/* Nothing of OpenCASCADE is torn down: that may crash too. */
[[noreturn]] void leave(int status)
{
    fflush(pipe_out);
    _exit(ferror(pipe_out) ? 1 : status);
}

class Progress : public Message_ProgressIndicator
{
    double reported = -1;

  protected:
    void Show(const Message_ProgressScope &, const Standard_Boolean) override
    {
        double done = GetPosition();
        if (!(done >= reported + 0.01))
            return;
        reported = done;
        put(SP_CAD_PROGRESS, &done, sizeof done);
        fflush(pipe_out);
    }
};

/* A body is what becomes a part: a solid, a shell that was sewn, or what is left of loose faces. */
struct Body {
    TopoDS_Shape shape;
    double volume; // m³, of a solid, else 0
};
struct Leaf {
    TopoDS_Shape shape;
    std::vector<Body> bodies;
};
struct Copy {
    std::string path; // texts as in a part's record
    TopLoc_Location where;
    size_t leaf;
};
struct Model {
    TopTools_IndexedMapOfShape known; // leaf i is known(i + 1)
    std::vector<Leaf> leaves;
    std::vector<Copy> copies;
    uint64_t fault_count = 0;
    std::string fault;
    sp_cad_fineness fineness = {};

    void add(const TopoDS_Shape &shape, const TopLoc_Location &where, const std::string &path);
    void add_fault(const std::string &text);
    void add_faults(const Handle(XSControl_WorkSession) & session);
    Bnd_Box box() const;
    void divide(double diagonal, const Message_ProgressRange &range);
    void mesh(double diagonal, const Message_ProgressRange &range);
    void write() const;
};

void Model::add(const TopoDS_Shape &shape, const TopLoc_Location &where, const std::string &path)
{
    if (shape.IsNull())
        return;
    size_t leaf = (size_t)known.Add(shape.Located(TopLoc_Location())) - 1;
    if (leaf == leaves.size())
        leaves.push_back({known((int)leaf + 1), {}});
    copies.push_back({path, where * shape.Location(), leaf});
}

void Model::add_fault(const std::string &text)
{
    if (fault_count++ == 0)
        fault = text;
}

/* What could not be read of the file's entities, or not be made into shapes. */
void Model::add_faults(const Handle(XSControl_WorkSession) & session)
{
    Handle(Interface_InterfaceModel) model = session->Model();
    for (int i = 1; !model.IsNull() && i <= model->NbEntities(); i++) {
        Handle(Interface_Check) check = model->Check(i, Standard_True);
        for (int k = 1; !check.IsNull() && k <= check->NbFails(); k++)
            add_fault("entity " + std::to_string(i) + ": " + check->CFail(k));
    }
    Interface_CheckIterator transfer = session->TransferReader()->TransientProcess()->CheckList(Standard_True);
    for (transfer.Start(); transfer.More(); transfer.Next())
        for (int k = 1; k <= transfer.Value()->NbFails(); k++)
            add_fault("entity " + std::to_string(transfer.Number()) + ": " + transfer.Value()->CFail(k));
}

Bnd_Box Model::box() const
{
    Bnd_Box whole;
    for (const Copy &copy : copies)
        BRepBndLib::Add(leaves[copy.leaf].shape.Moved(copy.where), whole, Standard_False);
    return whole;
}

double volume_of(const TopoDS_Shape &solid)
{
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solid, properties);
    return properties.Mass() * unit * unit * unit;
}

/* A sewn shell that is closed is a solid, its faces turned outwards. */
Body body_of(const TopoDS_Shell &shell)
{
    if (!BRep_Tool::IsClosed(shell))
        return {shell, 0};
    TopoDS_Solid solid;
    BRep_Builder builder;
    builder.MakeSolid(solid);
    builder.Add(solid, shell);
    BRepLib::OrientClosedSolid(solid);
    return {solid, volume_of(solid)};
}

std::vector<Body> sew_group(const std::vector<TopoDS_Shape> &faces, double tolerance,
                            const Message_ProgressRange &range)
{
    std::vector<Body> bodies;
    BRepBuilderAPI_Sewing sewing(tolerance);
    for (const TopoDS_Shape &face : faces)
        sewing.Add(face);
    sewing.Perform(range);
    for (TopExp_Explorer at(sewing.SewedShape(), TopAbs_SHELL); at.More(); at.Next())
        bodies.push_back(body_of(TopoDS::Shell(at.Current())));
    TopoDS_Compound rest;
    BRep_Builder builder;
    bool any = false;
    builder.MakeCompound(rest);
    for (TopExp_Explorer at(sewing.SewedShape(), TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next(), any = true)
        builder.Add(rest, at.Current());
    if (any)
        bodies.push_back({rest, 0});
    return bodies;
}

/* Where an edge runs: its ends and its middle, in steps. */
typedef std::array<long, 9> Trace;

Trace trace_of(const TopoDS_Edge &edge, double step)
{
    BRepAdaptor_Curve curve(edge);
    double first = curve.FirstParameter(), last = curve.LastParameter();
    gp_Pnt ends[2] = {curve.Value(first), curve.Value(last)}, middle = curve.Value((first + last) / 2);
    Trace points[2];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++) {
            points[i][k] = std::lround(ends[i].Coord(k + 1) / step);
            points[1 - i][3 + k] = points[i][k];
            points[i][6 + k] = std::lround(middle.Coord(k + 1) / step);
        }
    return std::min(points[0], points[1]);
}

size_t root_of(std::vector<size_t> &parent, size_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* Faces that share edges. Where more than two share one, bodies touch there, and those that follow each other in the
 * file belong together. */
std::vector<std::vector<TopoDS_Shape>> group(const std::vector<TopoDS_Shape> &faces, double step)
{
    std::map<Trace, std::vector<size_t>> at_edge;
    std::vector<size_t> parent(faces.size());
    for (size_t i = 0; i < faces.size(); i++) {
        parent[i] = i;
        for (TopExp_Explorer at(faces[i], TopAbs_EDGE); at.More(); at.Next())
            if (BRep_Tool::IsGeometric(TopoDS::Edge(at.Current())) &&
                !BRep_Tool::Degenerated(TopoDS::Edge(at.Current())))
                at_edge[trace_of(TopoDS::Edge(at.Current()), step)].push_back(i);
    }
    for (const auto &edge : at_edge)
        for (size_t k = 0; k + 1 < edge.second.size(); k += 2)
            parent[root_of(parent, edge.second[k])] = root_of(parent, edge.second[k + 1]);
    std::map<size_t, std::vector<TopoDS_Shape>> by_root;
    for (size_t i = 0; i < faces.size(); i++)
        by_root[root_of(parent, i)].push_back(faces[i]);
    std::vector<std::vector<TopoDS_Shape>> groups;
    for (const auto &one : by_root)
        groups.push_back(one.second);
    return groups;
}

/* Body by body where all come out closed, else all faces at once. */
std::vector<Body> sew(const std::vector<TopoDS_Shape> &faces, double tolerance, const Message_ProgressRange &range)
{
    std::vector<std::vector<TopoDS_Shape>> groups = group(faces, 10 * tolerance);
    std::vector<Body> bodies;
    Message_ProgressScope scope(range, "", (double)groups.size() + 1);
    bool closed = groups.size() > 1;
    for (size_t i = 0; closed && i < groups.size(); i++)
        for (const Body &body : sew_group(groups[i], tolerance, scope.Next())) {
            closed = closed && body.volume != 0;
            bodies.push_back(body);
        }
    return closed ? bodies : sew_group(faces, tolerance, scope.Next());
}

void Model::divide(double diagonal, const Message_ProgressRange &range)
{
    Message_ProgressScope scope(range, "", (double)leaves.size());
    fineness.sewing = SEWING_SHARE * diagonal * unit;
    for (Leaf &leaf : leaves) {
        Message_ProgressRange part = scope.Next();
        std::vector<TopoDS_Shape> loose;
        for (TopExp_Explorer at(leaf.shape, TopAbs_SOLID); at.More(); at.Next())
            leaf.bodies.push_back({at.Current(), volume_of(at.Current())});
        for (TopExp_Explorer at(leaf.shape, TopAbs_FACE, TopAbs_SOLID); at.More(); at.Next())
            loose.push_back(at.Current());
        fineness.sewn += loose.size();
        for (const Body &body : loose.empty() ? std::vector<Body>() : sew(loose, SEWING_SHARE * diagonal, part))
            leaf.bodies.push_back(body);
    }
}

void Model::mesh(double diagonal, const Message_ProgressRange &range)
{
    TopoDS_Compound all;
    BRep_Builder builder;
    builder.MakeCompound(all);
    for (const Leaf &leaf : leaves)
        for (const Body &body : leaf.bodies)
            builder.Add(all, body.shape);
    if (fineness.chord > 1e9 * diagonal * unit)
        fineness.chord = 1e9 * diagonal * unit;
    IMeshTools_Parameters parameters;
    parameters.Deflection = 0.5 * fineness.chord / unit; // spheres get up to twice what is asked for
    parameters.Angle = fineness.angle;
    BRepTools::Clean(all); // triangles that the file holds
    BRepMesh_IncrementalMesh mesher(all, parameters, range);
    TopLoc_Location where;
    std::string text;
    for (TopExp_Explorer at(all, TopAbs_FACE); at.More(); at.Next())
        if (BRep_Tool::Triangulation(TopoDS::Face(at.Current()), where).IsNull())
            add_fault("a face that cannot be cut into triangles");
        else if (!sp_cad_keeps_area(TopoDS::Face(at.Current()), fineness.angle, AREA_LEAST * diagonal * diagonal, unit,
                                    text))
            add_fault(text);
}

/* The nodes of the edges that a body's faces share, each the same to the last bit whichever face it is seen from, while
 * OpenCASCADE computes it anew for each. */
struct Edges {
    TopTools_IndexedMapOfShape known;
    std::vector<std::vector<gp_Pnt>> nodes;

    void share(const TopoDS_Edge &edge, const std::vector<int> &line, const gp_Trsf &where,
               std::vector<gp_Pnt> &points);
};

void Edges::share(const TopoDS_Edge &edge, const std::vector<int> &line, const gp_Trsf &where,
                  std::vector<gp_Pnt> &points)
{
    TopoDS_Vertex ends[2] = {TopExp::FirstVertex(edge), TopExp::LastVertex(edge)};
    size_t index = (size_t)known.Add(edge) - 1;
    if (index == nodes.size()) {
        nodes.push_back({});
        for (int node : line)
            nodes[index].push_back(points[(size_t)node - 1]);
        for (int i = 0; i < 2; i++)
            if (!ends[i].IsNull())
                (i ? nodes[index].back() : nodes[index].front()) = BRep_Tool::Pnt(ends[i]).Transformed(where);
        if (BRep_Tool::Degenerated(edge)) // at a pole all of it is a point
            nodes[index].assign(line.size(), nodes[index].front());
    }
    for (size_t i = 0; nodes[index].size() == line.size() && i < line.size(); i++)
        points[(size_t)line[i] - 1] = nodes[index][i];
}

std::vector<gp_Pnt> points_of(const TopoDS_Face &face, const Handle(Poly_Triangulation) & triangles,
                              const TopLoc_Location &within, const TopLoc_Location &where, Edges &edges)
{
    std::vector<gp_Pnt> points;
    gp_Trsf move = (where * within).Transformation();
    for (int i = 1; i <= triangles->NbNodes(); i++)
        points.push_back(triangles->Node(i).Transformed(move));
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
        const TopoDS_Edge &edge = TopoDS::Edge(at.Current());
        Handle(Poly_PolygonOnTriangulation) line = BRep_Tool::PolygonOnTriangulation(edge, triangles, within);
        std::vector<int> nodes;
        for (int i = 1; !line.IsNull() && i <= line->NbNodes(); i++)
            nodes.push_back(line->Node(i));
        if (nodes.size() >= 2)
            edges.share(edge, nodes, where.Transformation(), points);
    }
    return points;
}

void write_vertices(const std::vector<gp_Pnt> &points)
{
    std::vector<double> numbers;
    for (size_t i = 0; i < points.size(); i++) {
        for (int k = 1; k <= 3; k++)
            numbers.push_back(points[i].Coord(k) * unit);
        if (numbers.size() == 3 * RECORD_VERTICES || i + 1 == points.size()) {
            put(SP_CAD_VERTICES, numbers.data(), numbers.size() * sizeof numbers[0]);
            numbers.clear();
        }
    }
}

size_t write_triangles(const Handle(Poly_Triangulation) & triangles, bool turned, size_t first)
{
    std::vector<uint32_t> numbers;
    for (int i = 1; i <= triangles->NbTriangles(); i++) {
        int corners[3];
        triangles->Triangle(i).Get(corners[0], corners[turned ? 2 : 1], corners[turned ? 1 : 2]);
        for (int corner : corners)
            numbers.push_back((uint32_t)(first + (size_t)corner - 1));
        if (numbers.size() == 3 * RECORD_VERTICES || i == triangles->NbTriangles()) {
            put(SP_CAD_TRIANGLES, numbers.data(), numbers.size() * sizeof numbers[0]);
            numbers.clear();
        }
    }
    return (size_t)triangles->NbTriangles();
}

void write_body(const Body &body, const TopLoc_Location &where, sp_cad_totals *totals)
{
    Edges edges;
    size_t first = 0;
    for (TopExp_Explorer at(body.shape, TopAbs_FACE); at.More(); at.Next()) {
        TopLoc_Location within;
        const TopoDS_Face &face = TopoDS::Face(at.Current());
        Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, within);
        if (triangles.IsNull())
            continue;
        bool mirrored = (where * within).Transformation().IsNegative();
        write_vertices(points_of(face, triangles, within, where, edges));
        totals->triangles += write_triangles(triangles, (face.Orientation() == TopAbs_REVERSED) != mirrored, first);
        first += (size_t)triangles->NbNodes();
    }
    totals->vertices += first;
}

void Model::write() const
{
    sp_cad_totals totals = {0, 0, 0};
    put(SP_CAD_FINENESS, &fineness, sizeof fineness);
    if (fault_count)
        put_text(SP_CAD_FAULTS, std::string((const char *)&fault_count, sizeof fault_count), fault.c_str());
    for (const Copy &copy : copies)
        for (const Body &body : leaves[copy.leaf].bodies) {
            std::string bytes((const char *)&body.volume, sizeof body.volume);
            bytes += copy.path;
            put(SP_CAD_PART, bytes.data(), bytes.size());
            write_body(body, copy.where, &totals);
            totals.parts++;
        }
    put(SP_CAD_END, &totals, sizeof totals);
}

std::string name_of(const TDF_Label &label)
{
    Handle(TDataStd_Name) name;
    std::string text;
    if (label.FindAttribute(TDataStd_Name::GetID(), name))
        text = TCollection_AsciiString(name->Get()).ToCString();
    return text.substr(0, 1000).append(1, '\0');
}

/* The shapes below a label of the document, each with the names above it. */
void visit(Model &model, const TDF_Label &label, const TopLoc_Location &above, const std::string &path)
{
    bool copy = XCAFDoc_ShapeTool::IsReference(label);
    TDF_Label original = label;
    if (copy && !XCAFDoc_ShapeTool::GetReferredShape(label, original))
        return model.add_fault("a copy of nothing");
    TopLoc_Location where = copy ? above * XCAFDoc_ShapeTool::GetLocation(label) : above;
    std::string names = path + (copy ? name_of(label) : std::string(1, '\0')) + name_of(original);
    if (names.size() > SP_CAD_MOST_BYTES / 2)
        throw std::length_error("an assembly in too many levels");
    TDF_LabelSequence children;
    if (!XCAFDoc_ShapeTool::IsAssembly(original))
        return model.add(XCAFDoc_ShapeTool::GetShape(original), where, names);
    XCAFDoc_ShapeTool::GetComponents(original, children);
    for (int i = 1; i <= children.Length(); i++)
        visit(model, children.Value(i), where, names);
}

/* Returns how much of it cannot be right. */
size_t read_step(const char *file, int curves, Model &model, const Message_ProgressRange &range)
{
    STEPCAFControl_Reader reader;
    reader.SetColorMode(Standard_False);
    reader.SetLayerMode(Standard_False);
    reader.SetPropsMode(Standard_False);
    reader.SetGDTMode(Standard_False);
    reader.SetMatMode(Standard_False);
    Interface_Static::SetIVal("read.surfacecurve.mode", curves);
    Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
    if (reader.ReadFile(file) != IFSelect_RetDone)
        throw std::runtime_error("found no STEP file, or one that is damaged");
    if (!sp_cad_states_length_unit(reader.Reader().Model()))
        model.add_fault("no unit of length is stated, mm are taken");
    sp_cad_halve_revolved(reader.ChangeReader().Model());
    bool any = reader.Transfer(document, range);
    model.add_faults(reader.Reader().WS());
    std::vector<std::string> flaws = sp_cad_flaws(reader.Reader().WS());
    for (const std::string &flaw : flaws)
        model.add_fault(flaw);
    TDF_LabelSequence roots;
    XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(roots);
    for (int i = 1; any && i <= roots.Length(); i++)
        visit(model, roots.Value(i), TopLoc_Location(), "");
    return flaws.size();
}

/* Edges lie where their curves in space have them: in a surface's own coordinates both sides of a seam are the same
 * place, and OpenCASCADE takes the wrong one. Where that cannot be right either, the file is read as it prefers. */
void read_step_soundly(const char *file, Model &model, const Message_ProgressRange &range)
{
    enum { AS_THE_FILE_PREFERS = 0, IN_SPACE = 3 };
    Message_ProgressScope scope(range, "", 2);
    Model other;
    other.fineness = model.fineness;
    size_t flaws = read_step(file, IN_SPACE, model, scope.Next());
    if (flaws > 0 && read_step(file, AS_THE_FILE_PREFERS, other, scope.Next()) < flaws)
        model = other;
}

void read_iges(const char *file, Model &model, const Message_ProgressRange &range)
{
    IGESControl_Reader reader;
    if (reader.ReadFile(file) != IFSelect_RetDone)
        throw std::runtime_error("found no IGES file, or one that is damaged");
    for (const std::string &doubt : sp_cad_doubtful_lengths(reader.IGESModel()->GlobalSection()))
        model.add_fault(doubt);
    reader.TransferRoots(range);
    model.add_faults(reader.WS());
    model.add(reader.OneShape(), TopLoc_Location(), std::string(2, '\0'));
}

/* Whether it begins as OpenCASCADE's binary form does. */
bool is_binary_brep(std::istream &file)
{
    static const std::string begin = "Open CASCADE Topology";
    std::string found(begin.size(), '\0');
    (file >> std::ws).read(&found[0], found.size());
    return found == begin;
}

/* OpenCASCADE would read on behind the end of a file that was cut, for ever. */
void read_brep(const char *file, Model &model)
{
    static const char damaged[] = "found no BREP file, or one that is damaged";
    TopoDS_Shape shape;
    BRep_Builder builder;
    std::ifstream text(file);
    if (!text)
        throw std::runtime_error(damaged);
    if (is_binary_brep(text))
        throw std::runtime_error("found a binary BREP file, expected one of text, or STEP");
    text.clear();
    text.seekg(0);
    try {
        text.exceptions(std::ios::failbit | std::ios::badbit);
        BRepTools::Read(shape, text, builder);
    } catch (const std::ios_base::failure &) {
        throw std::runtime_error(damaged);
    }
    model.add(shape, TopLoc_Location(), std::string(2, '\0'));
}

void convert(const char *kind, const char *file, Model &model, double most_chord)
{
    Handle(Progress) progress = new Progress;
    Message_ProgressScope scope(progress->Start(), "", 10);
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    if (strcmp(kind, "step") == 0)
        read_step_soundly(file, model, scope.Next(4));
    else if (strcmp(kind, "iges") == 0)
        read_iges(file, model, scope.Next(4));
    else
        read_brep(file, model);
    Bnd_Box box = model.box();
    if (box.IsVoid() || box.IsOpen())
        throw std::runtime_error(box.IsVoid() ? "found no surface" : "found surface without end");
    double diagonal = std::sqrt(box.SquareExtent());
    if (!(model.fineness.chord > 0)) {
        model.fineness.chord = CHORD_SHARE * diagonal * unit;
        if (most_chord > 0 && most_chord < model.fineness.chord)
            model.fineness.chord = most_chord;
    }
    model.divide(diagonal, scope.Next(3));
    model.mesh(diagonal, scope.Next(3));
}

/* Of processor time the second more is what tells SIGXCPU from being killed. */
void limit(int resource, double most)
{
    struct rlimit limits;
    getrlimit(resource, &limits);
    if (limits.rlim_max == RLIM_INFINITY || most + 1 < (double)limits.rlim_max)
        limits.rlim_max = (rlim_t)most + 1;
    if (limits.rlim_cur == RLIM_INFINITY || most < (double)limits.rlim_cur)
        limits.rlim_cur = (rlim_t)most;
    setrlimit(resource, &limits);
}

/* OpenCASCADE tells standard output what it thinks of a file: that is not for the pipe. */
bool take_pipe()
{
    int pipe_end = dup(STDOUT_FILENO), nothing = open("/dev/null", O_WRONLY);
    pipe_out = pipe_end >= 0 ? fdopen(pipe_end, "wb") : nullptr;
    return pipe_out && nothing >= 0 && dup2(nothing, STDOUT_FILENO) >= 0;
}

/* What OpenCASCADE throws where nothing can catch it. */
[[noreturn]] void give_up()
{
    static const char text[] = "it gave up; where memory ran out, a longer chord takes less";
    put(SP_CAD_FAILURE, text, sizeof text - 1);
    leave(0);
}

} // namespace

int main(int count, char **arguments)
{
    if (count != 9) {
        fprintf(stderr, "sprayplan starts this program: sprayplan-cad step|iges|brep FILE UNIT CHORD MOST-CHORD ANGLE "
                        "BYTES SECONDS\n");
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL); // nobody would read what it writes
    limit(RLIMIT_AS, atof(arguments[7]));
    limit(RLIMIT_CPU, atof(arguments[8]));
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    if (!take_pipe())
        return 1;
    std::set_terminate(give_up);
    unit = atof(arguments[3]);
    const uint32_t format = SP_CAD_FORMAT;
    put(SP_CAD_GREETING, &format, sizeof format);
    try {
        Model model;
        model.fineness.chord = atof(arguments[4]);
        model.fineness.angle = atof(arguments[6]);
        convert(arguments[1], arguments[2], model, atof(arguments[5]));
        model.write();
        leave(0); // before what was made is torn down
    } catch (const Standard_Failure &failure) {
        const char *text = failure.GetMessageString();
        put_text(SP_CAD_FAILURE, failure.DynamicType()->Name(),
                 text && *text ? (std::string(": ") + text).c_str() : "");
    } catch (const std::bad_alloc &) {
        put_text(SP_CAD_FAILURE, "", "memory ran out; a longer chord takes less");
    } catch (const std::exception &failure) {
        put_text(SP_CAD_FAILURE, "", failure.what());
    }
    leave(0);
}
