# SPDX-License-Identifier: GPL-3.0-or-later
"""What measure.py can measure: programs, data sets, commands, and how their output becomes tables."""

import csv
import dataclasses
import io
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys

FOLDS = range(5)


@dataclasses.dataclass
class Context:
    root: pathlib.Path
    build: pathlib.Path
    shared: pathlib.Path
    quick: bool
    out: pathlib.Path  # runs that can go on keep their files below it

    @property
    def mortise(self):
        return self.build / "apps" / "mortise"

    def bench(self, name):
        """A script of this folder, or a program of the build's."""
        return [sys.executable, self.root / "bench" / name] if name.endswith(".py") else [self.build / "bench" / name]

    @property
    def pairs(self):
        return self.shared / "bm5" / "pairs.csv"


def table(columns, rows, notes=()):
    return {"columns": list(columns), "rows": [list(map(str, row)) for row in rows], "notes": list(notes)}


def markdown_tables(text):
    """The Markdown tables of a text, each with the lines that follow it as notes."""
    tables = []
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")]
        if not line.startswith("|"):
            if tables and line.strip():
                tables[-1]["notes"].append(line.strip())
        elif set(line) <= set("|- "):
            pass
        elif tables and not tables[-1]["notes"] and len(cells) == len(tables[-1]["columns"]):
            tables[-1]["rows"].append(cells)
        else:
            tables.append(table(cells, []))
    return tables


class Measurement:
    """Commands and how their output becomes tables; the simple ones are instances, the others override."""

    on_request = False  # only with --only

    def __init__(self, name, minutes, quick_minutes, tables=None, programs=(), data=()):
        self.name, self.minutes, self.quick_minutes = name, minutes, quick_minutes
        self.tables = tables or [name]
        self.programs, self.data = programs, data

    def missing(self, c):
        for program in self.programs:
            path = c.bench(program)[-1] if program != "mortise" else c.mortise
            if not os.access(path, os.X_OK):
                target = "mortise_program" if program == "mortise" else program
                return f"no {path}; cmake --build --preset release --target {target}"
        for file in self.data:
            if not (c.shared / file).exists():
                return f"no {c.shared / file}; scripts/data lays it out (README, Data)"
        return None

    def commands(self, c):
        raise NotImplementedError

    def outputs(self, c):
        for command in self.commands(c):
            yield subprocess.run(list(map(str, command)), check=True, cwd=c.root, text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE).stdout

    def run(self, c):
        found = [t for text in self.outputs(c) for t in markdown_tables(text)]
        if len(found) < len(self.tables):
            raise ValueError(f"expected {len(self.tables)} tables, found {len(found)}")
        return dict(zip(self.tables, found))


class Speed(Measurement):
    def commands(self, c):
        return [[*c.bench("docking_speed.py"), "--program", c.mortise, "--table", c.pairs, *(["--quick"] if c.quick else []),
                 "--", *further] for further in ([], ["--no-polish"])]

    def run(self, c):
        default, plain = [markdown_tables(text)[0] for text in self.outputs(c)]
        names = [row[0] for row in default["rows"]]
        if [row[0] for row in plain["rows"]] != names:
            raise ValueError("the runs with and without polish are not of the same pairs")
        cpu = default["columns"].index("CPU, s")
        default["columns"].insert(cpu + 1, "CPU without polish, s")
        for row, other in zip(default["rows"], plain["rows"]):
            row.insert(cpu + 1, other[cpu])
        return {"speed": default}


class Success(Measurement):
    """Docks the training pairs, each ranked by the potential fitted without its fold."""

    def __init__(self, name, minutes, further=(), on_request=False):
        super().__init__(name, minutes, 2, [name, f"{name}_cost"], ["mortise"], ["bm5/pairs.csv"])
        self.further, self.on_request = further, on_request

    def results(self, c):
        return [c.out / f"{self.name}{'_quick' if c.quick else ''}" / f"fold_{i}.csv" for i in FOLDS]

    def commands(self, c):
        with open(c.pairs, encoding="utf-8", newline="") as file:
            names = [row["name"] for row in csv.DictReader(file)]
        for i, path in zip(FOLDS, self.results(c)):
            yield [c.mortise, "benchmark", c.pairs, "--potential", c.root / "bench/data" / f"contacts_without_fold_{i}.txt",
                   "--fold", f"{i + 1}/5", "--jobs", str(os.cpu_count()), "--threads", "1", "--quiet", "-o", path,
                   *(["--subset", names[i]] if c.quick else []), *self.further]

    def run(self, c):
        for path in self.results(c):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.unlink(missing_ok=True)
        for _ in self.outputs(c):
            pass
        text = subprocess.run([*map(str, c.bench("success_table.py")), *map(str, self.results(c))], check=True, text=True,
                              capture_output=True).stdout
        counts = markdown_tables(text)[0]
        rows = [row for path in self.results(c) for row in read_rows(path)]
        cost = [[label, f"{statistics.fmean(v):.{d}f}", f"{statistics.median(v):.{d}f}", f"{min(v):.{d}f}", f"{max(v):.{d}f}"]
                for label, column, d in (("CPU, s", "cpu_seconds", 1), ("wall, s", "seconds", 1), ("peak, MB", "peak_memory_mb", 0))
                for v in [[float(row[column]) for row in rows if row[column]]]]
        return {self.name: counts, f"{self.name}_cost": table(["a pair", "mean", "median", "least", "most"], cost)}


def read_rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Mating(Measurement):
    SEEDS = (1, 2, 3)

    def commands(self, c):
        return [[*c.bench("mating_table.py"), c.mortise, "--seed", str(seed),
                 *(["--only", "mortise_tenon_close,cross_lap_exact"] if c.quick else []),
                 "--", "--threads", "1", "--check", "0", "--poses", "20"] for seed in (self.SEEDS[:1] if c.quick else self.SEEDS)]

    def run(self, c):
        seeds, counts = [], []
        for seed, text in zip(self.SEEDS, self.outputs(c)):
            found = markdown_tables(text)[0]
            seeds.append(found)
            total, first, ten, close = numbers_of_mating(found["notes"][0])
            counts.append([seed, f"{first} of {total}", ten, close])
        one = seeds[0]
        rank, error = one["columns"].index("rank within 2%"), one["columns"].index("largest error, %")
        for column in (rank, error):
            one["columns"][column] += ", seed " + " / ".join(str(s) for s in self.SEEDS[:len(seeds)])
        for i, row in enumerate(one["rows"]):
            for column in (rank, error):
                row[column] = " / ".join(other["rows"][i][column] if other is not one else row[column] for other in seeds)
        one["notes"] = [n for n in one["notes"] if n.startswith("- ")]
        cpu, mb = one["columns"].index("CPU, s"), one["columns"].index("MB")
        every = [row for found in seeds for row in found["rows"]]
        cost = [f"{min(float(r[cpu]) for r in every):.1f} to {max(float(r[cpu]) for r in every):.1f} CPU seconds, "
                f"{min(int(r[mb]) for r in every)} to {max(int(r[mb]) for r in every)} MB a pair."]
        return {"mating": one, "mating_counts": table(
            ["seed", "at rank 1", "within the top 10", "within 0.2% of the diameter"], counts, cost)}


def numbers_of_mating(line):
    """Pairs, at rank 1, within the top 10, within 0.2%: from the last line of mating_table.py."""
    found = re.match(r"(\d+) pairs: (\d+) at rank 1, (\d+) within the top 10, \d+ found; (\d+) within 0\.2%", line)
    if not found:
        raise ValueError(f"mating_table.py: unexpected {line!r}")
    return tuple(map(int, found.groups()))


class Script(Measurement):
    """A script that prints Markdown."""

    def __init__(self, name, minutes, quick_minutes, words, quick_words, **keys):
        super().__init__(name, minutes, quick_minutes, **keys)
        self.words, self.quick_words = words, quick_words

    def commands(self, c):
        program, *rest = self.quick_words if c.quick else self.words
        return [[*c.bench(program), *(fill(c, word) for word in rest)]]


def fill(c, word):
    return str(word).format(mortise=c.mortise, build=c.build, shared=c.shared, root=c.root, out=c.out)


class Columns(Script):
    """A program that prints one table in columns of blanks, headings two blanks apart."""

    def run(self, c):
        lines = next(self.outputs(c)).splitlines()
        return {self.name: table(re.split(r"\s{2,}", lines[0].strip()), [line.split() for line in lines[1:] if line.strip()])}


class Csv(Script):
    def run(self, c):
        rows = list(csv.reader(io.StringIO(next(self.outputs(c)))))
        return {self.name: table(rows[0], rows[1:])}


class Lines(Script):
    """A program that prints lines for people: one cell a line."""

    def run(self, c):
        return {self.name: table(["output"], [[line.strip()] for line in next(self.outputs(c)).splitlines() if line.strip()])}


class GoogleBenchmark(Script):
    """CPU time of each benchmark and its counters; medians of repetitions in the long form."""

    def commands(self, c):
        return [[*command, "--benchmark_format=json"] for command in super().commands(c)]

    def run(self, c):
        found = json.loads(next(self.outputs(c)))["benchmarks"]
        medians = [b for b in found if b.get("aggregate_name") == "median"]
        rows, counters = [], []
        known = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "repetition_index",
                 "threads", "iterations", "real_time", "cpu_time", "time_unit", "aggregate_name", "aggregate_unit", "label"}
        for b in medians or found:
            counters += [key for key in b if key not in known and key not in counters]
        for b in medians or found:
            rows.append([b["run_name"], f"{b['cpu_time']:.4g} {b['time_unit']}",
                         *(f"{b[key]:.4g}" if key in b else "" for key in counters)])
        return {self.name: table(["benchmark", "CPU", *counters], rows)}


class Fourier(GoogleBenchmark):
    """nfft_bench: whole transforms beside bare FFTW, and the 4D form beside the direct sum."""

    def run(self, c):
        found = json.loads(next(self.outputs(c)))["benchmarks"]
        medians = [b for b in found if b.get("aggregate_name") == "median"] or found
        three, four, throughput = [], [], []
        for b in medians:
            name, *sizes = b["run_name"].split("/")
            if name == "BM_NfftOfProtein":
                three.append([f"{int(sizes[0]):,}", f"{sizes[1]}^3", f"1e-{sizes[2]}", f"{b['nfft_us']:.0f}", f"{b['fft_us']:.0f}",
                              f"{b['ratio']:.2f}", f"{b['spread_knots_per_s'] / 1e6:.0f}"])
            elif name == "BM_Nfft4dAgainstDirectSum":
                four.append([f"{int(sizes[0]):,}", f"{b['nfft_ms']:.3g}", f"{b['direct_ms']:.3g}", f"{b['speedup']:.2g}"])
            else:
                throughput.append([f"1e-{sizes[0]}", f"{b['width']:.0f}", f"{b['knots'] / 1e6:.2f}"])
        return {"fourier": table(["atoms", "grid", "tolerance", "NFFT, us", "bare FFTW, us", "ratio", "knots spread, million/s"], three),
                "fourier_4d": table(["knots", "4D NFFT, ms", "direct sum, ms", "times faster"], four),
                "fourier_throughput": table(["tolerance", "width", "knots, million/s"], throughput)}


class Rotations(Measurement):
    def commands(self, c):
        return [[c.mortise, "rotations", "--count", count, "--method", method, "--json"]
                for count in (("3600",) if c.quick else ("3600", "54000")) for method in ("auto", "super-fibonacci")]

    def run(self, c):
        found = [json.loads(text) for text in self.outputs(c)]
        rows = [[f"{a['count']:,}", f"{a['covering_radius_degrees']:.2f} degrees", f"{b['covering_radius_degrees']:.2f}"]
                for a, b in zip(found[::2], found[1::2])]
        return {"rotations": table(["rotations", "Mortise (stored icosahedral sets)", "super-Fibonacci"], rows)}


class Decomposition(Measurement):
    def commands(self, c):
        meshes = [c.shared / "meshes" / "stanford-bunny.obj", c.shared / "meshes" / "rocker-arm.obj"]
        if c.quick:
            return [[*c.bench("decompose_bench"), "--largest", "32", meshes[0]]]
        return [[*c.bench("decomposition_table.py"), "--build", c.build, "--csv", c.out / "decomposition.csv", "--balls",
                 c.out / "balls", *meshes]]

    def run(self, c):
        c.out.mkdir(parents=True, exist_ok=True)
        if c.quick:
            rows = list(csv.reader(io.StringIO(next(self.outputs(c)))))
            return {"decomposition_csv": table(rows[0], rows[1:])}
        (c.out / "decomposition.csv").unlink(missing_ok=True)  # the script would only print one that is there
        found = super().run(c)
        for one in found.values():
            one["notes"] = []  # headings of the table that follows
        return found


class Interfaces(Measurement):
    def commands(self, c):
        return [[*c.bench("interface_bench"), c.pairs]]

    def run(self, c):
        c.out.mkdir(parents=True, exist_ok=True)
        path = c.out / "interfaces.csv"
        path.write_text(next(self.outputs(c)), encoding="utf-8")
        text = subprocess.run([*map(str, c.bench("interface_table.py")), str(path)], check=True, text=True, capture_output=True).stdout
        return {"interfaces": markdown_tables(text)[0]}

    def missing(self, c):
        return super().missing(c) or ("no quick form: it describes all pairs" if c.quick else None)


def cell(store, name, row, column):
    """The cell of the first row of table `name` whose first cell begins with `row`. @throws KeyError naming the measurement"""
    for entry in store.values():
        if name in entry["tables"]:
            found = entry["tables"][name]
            for cells in found["rows"]:
                if cells[0].startswith(row):
                    return cells[found["columns"].index(column)]
    raise KeyError(name)


def seconds_in(store, row):
    """User seconds in the line of parts_bench that begins with `row`."""
    return re.search(r"([\d.]+) s user", cell(store, "parts", row, "output")).group(1)


def parts_summary(store):
    """README's table of mating, collision and force; each row names its measurement."""
    rows, used = [], []

    def row(what, figure, measurement):
        rows.append([what, figure, f"`{measurement}`"])
        used.append(measurement)

    counts = {seed: [cell(store, "mating_counts", seed, column) for column in
                     ("at rank 1", "within the top 10", "within 0.2% of the diameter")] for seed in "123"}
    row("the sample pairs mated from a random start, within 2% of the diameter, seeds 1 / 2 / 3; `docs/mating.md`",
        f"at rank 1: {' / '.join(c[0] for c in counts.values())}; in the top 10: {' / '.join(c[1] for c in counts.values())}; "
        f"within 0.2%: {' / '.join(c[2] for c in counts.values())}. "
        + store["mating"]["tables"]["mating_counts"]["notes"][0], "mating")
    row("signed distance of 403,280 triangles at 128^3 nodes, one core", seconds_in(store, "distance at") + " s", "parts")
    row("skeletal density of the same, sigma 0.5", seconds_in(store, "skeletal density, sigma 0.5") + " s", "parts")
    row("gap value and its six derivatives, m' = 4,096", cell(store, "gap", "gap_wrench/4096", "CPU"), "gap")
    row("the same, strictly 4,096 pairs of modes", cell(store, "gap", "gap_wrench/8192", "CPU"), "gap")
    for size in ("1280", "403280"):
        row(f"certified answers near contact, {int(size):,} triangles, beside FCL 0.7",
            f"{cell(store, 'fcl', size, 'trees q/s')} a second against {cell(store, 'fcl', size, 'FCL q/s')}; "
            f"{cell(store, 'fcl', size, 'band')} of 10,000 within the band, {cell(store, 'fcl', size, 'wrong')} wrong", "fcl")
    row("force and torque of more than 300,000 triangles a part at 1 kHz, microseconds",
        f"{cell(store, 'latency', 'wrench', 'median')} median, {cell(store, 'latency', 'wrench', '99.9%')} at 99.9%; "
        f"whole step {cell(store, 'latency', 'whole step', '99.9%')} at 99.9%", "latency")
    row("parts let go near the mate, 50 starts a pair; `docs/mating.md`",
        f"{cell(store, 'letting_go', 'all', 'end in the mate')} of {cell(store, 'letting_go', 'all', 'starts')} end in the mate",
        "letting_go")
    row("clusters of 10,000 poses by ligand RMSD, 3 and 10 A",
        f"{cell(store, 'clusters', 'by_ligand_rmsd/10000/3', 'CPU')} and {cell(store, 'clusters', 'by_ligand_rmsd/10000/10', 'CPU')}",
        "clusters")
    return table(["what", "figure", "measurement"], rows), list(dict.fromkeys(used))


# Tables made of several measurements: name to a function of the store that gives table and measurements used.
SUMMARIES = {"parts_summary": parts_summary}

ALL = [
    Rotations("rotations", 1, 0.2, programs=["mortise"]),
    Speed("speed", 4, 0.5, programs=["mortise"]),
    Fourier("fourier", 1, 0.3, ["nfft_bench", "--benchmark_repetitions=5"],
            ["nfft_bench", "--benchmark_filter=BM_NfftOfProtein|Sum/(100|1000)/"],
            tables=["fourier", "fourier_4d", "fourier_throughput"], programs=["nfft_bench"]),
    Lines("search_steps", 0.5, 0.2, ["search_bench", "--threads", "1"],
          ["search_bench", "--threads", "1", "--rotations", "300", "{root}/molecules/1hpv_receptor.pdb",
           "{root}/molecules/1hpv_ligand.pdb"], programs=["search_bench"]),
    GoogleBenchmark("gap", 1, 0.2, ["gap_bench", "--benchmark_repetitions=5"], ["gap_bench", "--benchmark_min_time=0.05"],
                    programs=["gap_bench"]),
    GoogleBenchmark("clusters", 1, 0.3, ["cluster_bench", "--benchmark_repetitions=3"],
                    ["cluster_bench", "--benchmark_min_time=0.01", "--benchmark_filter=by_.*/10000/"], programs=["cluster_bench"]),
    Lines("parts", 1, 0.2, "parts_bench --threads 1 --sigma 0.1 --sigma 0.5 bumps 400000".split(),
          "parts_bench --threads 1 --nodes 48 --sigma 0.5 bumps 20000".split(), programs=["parts_bench"]),
    Columns("fcl", 5, 0.2, "fcl_compare --poses 10000 --triangles 1000,20000,400000".split(),
            "fcl_compare --poses 1000 --triangles 1000".split(), programs=["fcl_compare"]),
    Csv("minkowski", 1, 0.2, ["minkowski_bench", "1000x1000", "3686x1081"], ["minkowski_bench", "300x300"],
        programs=["minkowski_bench"]),
    Script("latency", 1, 0.3, ["assembly_latency.py", "{mortise}"],
           ["assembly_latency.py", "{mortise}", "--triangles", "5000", "--", "--grid", "48", "--seconds", "2"], programs=["mortise"]),
    Script("letting_go", 2, 0.2, ["assembly_table.py", "{mortise}"],
           ["assembly_table.py", "{mortise}", "--only", "round_peg_close,cross_lap_exact", "--", "--free", "10", "--grid", "32"],
           programs=["mortise"]),
    Mating("mating", 15, 0.5, ["mating", "mating_counts"], programs=["mortise"]),
    Script("furniture", 3, 1, "mating_table.py {mortise} --seed 1 --table {shared}/meshes/furniture/mates.csv --screws "
           "{root}/bench/data/furniture_screws.json -- --threads 1 --check 0 --poses 20".split(),
           ["mating_table.py", "{mortise}", "--table", "{shared}/meshes/furniture/mates.csv", "--only", "chair_seat chair_back", "--",
            "--threads", "1", "--check", "0", "--poses", "20"], programs=["mortise"], data=["meshes/furniture/mates.csv"]),
    Interfaces("interfaces", 2, 0, programs=["interface_bench"], data=["bm5/pairs.csv"]),
    Decomposition("decomposition", 15, 0.5, ["decomposition_a2", "decomposition_methods", "decomposition_1"],
                  ["decompose_bench"], ["meshes/stanford-bunny.obj", "meshes/rocker-arm.obj"]),
    Success("success", 8),
    Success("success_no_polish", 6, ["--no-polish"]),
    Success("success_fast", 5, ["--preset", "fast"]),
    Success("success_shape", 5, ["--no-rescore"], on_request=True),
    Success("success_thorough", 45, ["--preset", "thorough"], on_request=True),
]
