// SPDX-License-Identifier: GPL-3.0-or-later
// STEP files in and out of OpenCASCADE, in memory and without its messages.
#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <array>
#include <fstream>
#include <sstream>

#include "mortise/core/errors.hpp"
#include "parts/step/brep.hpp"

namespace mortise::brep {
namespace {

struct Unit {
  const char* ours;
  const char* in_files;    // as the reader reports it
  const char* for_writer;  // as the writer's option write.step.unit has it
  double millimetres;
};

constexpr std::array<Unit, 9> kUnits = {{{"mm", "millimetre", "MM", 1.0},
                                         {"cm", "centimetre", "CM", 10.0},
                                         {"m", "metre", "M", 1000.0},
                                         {"km", "kilometre", "KM", 1e6},
                                         {"um", "micrometre", "UM", 1e-3},
                                         {"in", "inch", "INCH", 25.4},
                                         {"ft", "foot", "FT", 304.8},
                                         {"mi", "mile", "MI", 1609344.0},
                                         {"mil", "mil", "MIL", 0.0254}}};

/// OpenCASCADE reports progress to stdout unless told not to.
void silence() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

double millimetres_per(const std::string& name) {
  for (const Unit& unit : kUnits) {
    if (name == unit.ours) return unit.millimetres;
  }
  throw InputError("STEP: expected a unit of mm, cm, m, km, um, in, ft, mi or mil, found '" + name +
                   "'");
}

UnitShape read(const std::string& path) {
  silence();
  STEPControl_Reader reader;
  try {
    std::ifstream stream(path, std::ios::binary);
    if (!stream || reader.ReadStream(path.c_str(), stream) != IFSelect_RetDone)
      throw FileError(path, "expected a STEP file, found something else");
    TColStd_SequenceOfAsciiString lengths;
    TColStd_SequenceOfAsciiString angles;
    TColStd_SequenceOfAsciiString solid_angles;
    reader.FileUnits(lengths, angles, solid_angles);
    UnitShape part;
    if (!lengths.IsEmpty()) {
      const std::string name = lower_case(lengths.First().ToCString());
      for (const Unit& unit : kUnits) {
        if (name == unit.in_files) {
          part.unit = unit.ours;
          part.millimetres = unit.millimetres;
        }
      }
    }
    reader.TransferRoots();
    part.shape = reader.OneShape();
    if (part.shape.IsNull())
      throw FileError(path, "expected a shape, found a STEP file without one");
    return part;
  } catch (const Standard_Failure& failure) {
    throw FileError(path, std::string("OpenCASCADE cannot read it: ") + failure.GetMessageString());
  }
}

std::string to_step(const UnitShape& part) {
  silence();
  const char* unit_name = "MM";
  for (const Unit& unit : kUnits) {
    if (part.unit == unit.ours) unit_name = unit.for_writer;
  }
  try {
    STEPControl_Controller::Init();  // makes the options that are set next
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    Interface_Static::SetCVal("write.step.unit", unit_name);
    Interface_Static::SetIVal("write.surfacecurve.mode", 0);  // curves in space suffice
    STEPControl_Writer writer;                                // takes the unit now
    if (writer.Transfer(part.shape, STEPControl_AsIs) != IFSelect_RetDone)
      throw InputError("write STEP: OpenCASCADE cannot represent this shape");
    const Handle(StepData_StepModel) model = writer.Model();
    const auto text = [](const char* t) { return new TCollection_HAsciiString(t); };
    for (int i = 1; i <= model->NbEntities(); ++i) {
      const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i));
      if (product.IsNull()) continue;
      product->SetId(text("part"));  // OpenCASCADE counts the products of the process
      product->SetName(text("part"));
    }
    APIHeaderSection_MakeHeader header(model);
    header.SetName(text("part"));
    header.SetTimeStamp(text("1970-01-01T00:00:00"));  // the same part, the same bytes
    header.SetAuthorValue(1, text(""));
    header.SetOrganizationValue(1, text(""));
    header.SetPreprocessorVersion(text("Open CASCADE"));
    header.SetOriginatingSystem(text("Mortise"));
    StepData_StepWriter printer(model);
    printer.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
    std::ostringstream bytes;
    printer.Print(bytes);
    return bytes.str();
  } catch (const Standard_Failure& failure) {
    throw InputError(std::string("write STEP: OpenCASCADE fails: ") + failure.GetMessageString());
  }
}

}  // namespace mortise::brep
