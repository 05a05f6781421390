// SPDX-License-Identifier: GPL-3.0-or-later
// The embedded Python interpreter and OpenMM's readers of PDB and mmCIF, behind one C++ function.
#include "molecules/openmm_reader.hpp"

#include <dlfcn.h>
#include <pybind11/embed.h>

#include <array>
#include <cstdio>
#include <mutex>
#include <stdexcept>

#include "molecules/cif_value.hpp"
#include "mortise/core/errors.hpp"

namespace py = pybind11;

namespace mortise::molecules {
namespace {

// Importing openmm.app as a whole costs 190 ms of CPU time, most of it for numpy, distutils and the
// simulation core, none of which the readers use. So the packages openmm and openmm.app are entered
// as bare folders, which leaves 20 ms; should that fail with another version, they are imported
// whole. Names are left as the file has them (OpenMM would rename HSD to HIS), and no bonds are
// made.
constexpr char kReaderSource[] = R"python(
import gc, importlib.util, io, sys, types, warnings

def _bare_import():
    if 'openmm' in sys.modules:
        raise ImportError('openmm is loaded already')
    root = importlib.util.find_spec('openmm').submodule_search_locations[0]
    hidden = 'numpy' not in sys.modules
    if hidden:
        sys.modules['numpy'] = None
    try:
        openmm = sys.modules['openmm'] = types.ModuleType('openmm')
        openmm.__path__ = [root]
        app = sys.modules['openmm.app'] = openmm.app = types.ModuleType('openmm.app')
        app.__path__ = [root + '/app']
        openmm.Platform = None
        from openmm.vec3 import Vec3
        openmm.Vec3 = Vec3
        from openmm.app.topology import Topology
        app.Topology = Topology
        import openmm.app.pdbfile
        app.PDBFile = openmm.app.pdbfile.PDBFile
        import openmm.app.pdbxfile
        return openmm.app.pdbfile, openmm.app.pdbxfile
    finally:
        if hidden:
            del sys.modules['numpy']

def _whole_import():
    import openmm.app
    return sys.modules['openmm.app.pdbfile'], sys.modules['openmm.app.pdbxfile']

def _load(own_interpreter):
    if own_interpreter:
        try:
            return _bare_import()
        except Exception:
            for name in [n for n in sys.modules if n.split('.')[0] == 'openmm']:
                del sys.modules[name]
    return _whole_import()

def make_reader(own_interpreter):
    pdb_module, pdbx_module = _load(own_interpreter)
    nanometers = pdb_module.nanometers

    class BondlessTopology(pdb_module.Topology):
        def createStandardBonds(self):
            pass
        def createDisulfideBonds(self, positions):
            pass

    if own_interpreter:
        pdb_module.Topology = pdbx_module.Topology = BondlessTopology
        # The tables of other names are read from a file unless this one holds something.
        pdb_module.PDBFile._residueNameReplacements = {None: None}

    def read(text, is_pdb):
        collecting = gc.isenabled()
        gc.disable()  # tens of thousands of new objects, none of them garbage yet
        try:
            with warnings.catch_warnings():
                warnings.simplefilter('ignore')
                reader = (pdb_module.PDBFile if is_pdb else pdbx_module.PDBxFile)(io.StringIO(text))
            ids = [int(atom.id) for atom in reader.topology.atoms()]
            return ids, reader.getPositions().value_in_unit(nanometers)
        finally:
            if collecting:
                gc.enable()
    return read
)python";

std::string error_text(const PyStatus& status) {
  return status.err_msg != nullptr ? status.err_msg : "unknown reason";
}

void start_interpreter() {
  // Extension modules of Debian's Python look its symbols up globally; if this library was itself
  // opened by dlopen, they are local until raised.
  Dl_info info;
  if (dladdr(reinterpret_cast<void*>(&Py_InitializeFromConfig), &info) != 0)
    dlopen(info.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);

  PyConfig config;
  PyConfig_InitIsolatedConfig(&config);  // no PYTHONHOME, no user folder, no path of the caller
  config.install_signal_handlers = 0;    // Ctrl-C is the program's
  PyStatus status = PyConfig_SetBytesString(&config, &config.program_name, MORTISE_PYTHON);
  if (!PyStatus_Exception(status))
    status = PyConfig_SetBytesString(&config, &config.executable, MORTISE_PYTHON);
  if (!PyStatus_Exception(status)) status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status))
    throw std::runtime_error("cannot start Python (" MORTISE_PYTHON "): " + error_text(status));
  PyEval_SaveThread();  // from here on each caller takes the lock for itself
}

/// The Python function `read`; never released, as the interpreter is never ended.
const py::object& reader() {
  static std::mutex mutex;
  static const py::object* function = nullptr;
  {
    const std::lock_guard lock(mutex);
    if (function != nullptr) return *function;
    static bool own = false;
    if (Py_IsInitialized() == 0) {
      start_interpreter();
      own = true;
    }
    const py::gil_scoped_acquire gil;
    try {
      py::dict scope;
      scope["__builtins__"] = py::module_::import("builtins");
      py::exec(kReaderSource, scope);
      function = new py::object(scope["make_reader"](own));
    } catch (const py::error_already_set& e) {
      throw std::runtime_error(
          std::string("expected OpenMM in Python (Debian's package python3-simtk), found: ") +
          e.what());
    }
  }
  return *function;
}

// What OpenMM reads is each selected record of the file with the settled parts made plain: a serial
// number to know it by, no alternate location, the element; and a name of its own where a residue
// repeats one, as OpenMM would drop it.
void append_pdb(std::string& text, const AtomRecord& record, std::size_t serial) {
  const Atom& a = record.atom;
  char part[32];
  std::snprintf(part, sizeof part, "ATOM  %5zu ", serial);
  text += part;
  if (record.repeated_name) {
    std::snprintf(part, sizeof part, "%04zx", serial % 0x10000);
    text += part;
  } else {
    text += record.source.substr(12, 4);
  }
  text += ' ';
  text += record.source.substr(17, 3);
  text += ' ';
  text += record.source.substr(21, 1);
  std::snprintf(part, sizeof part, "%4d", a.residue_number % 10000);
  text += part;
  text += record.source.substr(26, 28);
  std::snprintf(part, sizeof part, "  1.00  0.00          %2s\n",
                a.element.empty() ? "EP" : a.element.c_str());
  text += part;
}

constexpr char kMmcifHead[] =
    "data_mortise\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
    "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n"
    "_atom_site.label_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.Cartn_x\n"
    "_atom_site.Cartn_y\n_atom_site.Cartn_z\n";

void append_mmcif(std::string& text, const AtomRecord& record, std::size_t serial) {
  const Atom& a = record.atom;
  const std::array<std::string, 8> values = {std::to_string(serial),
                                             a.element,
                                             a.name,
                                             std::string(),
                                             a.residue_name,
                                             a.chain,
                                             std::to_string(a.residue_number),
                                             a.insertion_code};
  for (const std::string& value : values) text += cif_value(value) + ' ';
  for (const std::string_view coordinate : record.coordinates) {
    text += coordinate;
    text += ' ';
  }
  text.back() = '\n';
}

}  // namespace

Eigen::Matrix3Xd read_positions_with_openmm(const std::string& path,
                                            const std::vector<AtomRecord>& records, Format format) {
  // OpenMM's objects take some 5 kB per atom and its serial numbers have five digits: read a large
  // file in parts.
  constexpr std::size_t kPart = 20000;
  constexpr double kAngstromPerNanometer = 10.0;
  const py::object& read = reader();
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(records.size()));
  for (std::size_t first = 0; first < records.size(); first += kPart) {
    const std::size_t count = std::min(kPart, records.size() - first);
    std::string text = format == Format::kMmcif ? kMmcifHead : "";
    text.reserve(82 * count);
    for (std::size_t i = 0; i < count; ++i)
      (format == Format::kMmcif ? append_mmcif : append_pdb)(text, records[first + i], i + 1);
    text += format == Format::kMmcif ? "#\n" : "END\n";

    const py::gil_scoped_acquire gil;
    try {
      const py::tuple result = read(py::str(text), format == Format::kPdb);
      const py::list ids = result[0], places = result[1];
      if (ids.size() != count || places.size() != count)
        throw std::runtime_error("OpenMM kept " + std::to_string(ids.size()) + " of " +
                                 std::to_string(count) + " atoms of " + path);
      for (std::size_t i = 0; i < count; ++i) {
        const auto id = ids[i].cast<std::size_t>();
        if (id < 1 || id > count)
          throw std::runtime_error("OpenMM changed atom numbers of " + path);
        const py::tuple place = places[i];
        for (int axis = 0; axis < 3; ++axis)
          positions(axis, static_cast<Eigen::Index>(first + id - 1)) =
              kAngstromPerNanometer * place[axis].cast<double>();
      }
    } catch (const py::error_already_set& e) {
      throw FileError(path, std::string("OpenMM cannot read it: ") + e.what());
    }
  }
  return positions;
}

}  // namespace mortise::molecules
