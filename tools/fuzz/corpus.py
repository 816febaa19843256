"""What once went wrong, or easily could: values, units, keys and files that are drawn again and again."""

from collections.abc import Iterator

#: Texts where a quantity is due.
QUANTITIES = (
    *("10 rad/s**9**9**9", "1 rad//s", "1 rad/s!", "1 " + "m" * 100_000),
    *("1 " + "/".join(["m"] * 5000), "1 m**99999999999999999999", "1 m**1e308", "1 m**-1e-323"),
    *("1e308 km", "1e-323 Hz", "-1e309 rad/s", "1e308 s", "9" * 5000 + " rad/s", "0x10 rad/s"),
    *("1_0 rad/s", "nan rad/s", "inf rad/s", "-0.0 rad/s", "١٠ rad/s", "1 µm", "1 μm", "1 °"),
    *("1 1/min", "1 mPas", "1,5 mm", "1 mm²/s", "1 (m", "1 m)", "1 ((((((m))))))", "1 m*", "1 *m"),
    *("1 m^2", "1 \x00", "1 \x1b[31mm", "1 \u202em", "\ud800"[:0] + "1 \ufffe", "", " ", "%"),
    *("100 %", "__import__('os')", "{0.__class__}", "%s%n"),
)
#: Numbers as TOML writes them.
NUMBERS = (
    *("0", "-0", "-1", "1e308", "-1e308", "1e-323", "5e-324", "inf", "-inf", "nan"),
    *("9223372036854775807", "9223372036854775808", "-9223372036854775809", "1" + "0" * 400),
    *("1" + "0" * 5000, "0x" + "f" * 64, "1e99999", "0.1e-99999", "1979-05-27T07:32:00Z"),
    *("1979-05-27", "07:32:00", "true"),
)
#: Formulas of errors.
FORMULAS = (
    *("5 * sin(2 * pi * i / z)", "(-8)**(1/3)", "max(0.5, h, 1-h)", "sin(h, h)", "1e308 * 10", "h / 0"),
    *("__import__('os')", "h.__class__", "[1, 2]", "lambda: 1", "h if f else i", "2**99999", "abs()", "()"),
    *(
        "i" + " + i" * 5000,
        "(" * 300 + "h" + ")" * 300,
        "sqrt(h - 1)",
        "log(0)",
        "1 < h < 2",
        "h[0]",
        "not h",
    ),
    *(
        "loss >= 0",
        "contact_ratio >= start",
        "loss",
        "film_min <= 1 um",
        "x = 1",
        "min(h, f)",
        "exp(1e9 * h)",
    ),
)
#: Names of files and models.
NAMES = (
    *("..", "/", "/dev/zero", "/dev/stdin", "/etc/passwd", "../../../../etc/passwd", "\\0"),
    *("a.toml", "a.csv", "C:\\\\x", "~", "$HOME", "crc-23-47", "." * 300, "a" * 5000),
    *("http://localhost/", "file:///etc/passwd", "<script>alert(1)</script>"),
)
#: Pieces of TOML.
PIECES = (
    "[" * 2000,
    "]" * 2000,
    "{" * 500,
    "x = " + "[" * 1500 + "]" * 1500 + "\n",
    "x = " + "{a = " * 1500 + "1" + "}" * 1500 + "\n",
    "a" + ".a" * 3000 + " = 1\n",
    "[a" + ".a" * 3000 + "]\n",
    '"""' + '"' * 100,
    "'''",
    "\r",
    "\r\n",
    "\x00",
    "\x1b]0;title\x07",
    "\ufeff",
    "\u2028",
    "#" + "c" * 100_000 + "\n",
    "[operating]\n",
    "[[operating]]\n",
    "[drive.pinion]\n",
    'title = "\\u001b[31mred"\n',
    'title = "\\u202edesrever"\n',
    'kind = "sweep"\n',
    'kind = ["gear-pair"]\n',
    "kind = 1\n",
    "= 1\n",
    "a = \n",
    "a = 1\na = 2\n",
    "solver = 1\n",
    'solver.cycles = "20"\n',
    "operating.gear_torque_harmonics = [{}]\n",
    'operating.gear_torque_table = "/dev/zero"\n',
    'mesh.table = "."\n',
    "output.samples_per_cycle = 1000000000000\n",
    "solver.cycles = 99999999999999999999\n",
    "mesh.slices = 1e9\n",
)
#: Axes of sweeps, behind the key.
RANGES = (
    *("1:2:1e-300rad/s", "1:2/99999999999999999999 rad/s", "1e308:-1e308:1rad/s"),
    *("-1e308:1e308/3rad/s", "0:0:0rad/s", "1:2:-1rad/s", "nan:1:1rad/s", ",,,", "1,2,rad/s", ":"),
    *("1:", "::", "1:2:3:4rad/s", "1 rad/s, 2 rad/s", "1e5000:2:3rad/s", "1:2/0rad/s"),
    *("1:2/1e3rad/s", "1" * 5000 + ":2:1rad/s", ",".join(["1"] * 200_000) + "rad/s"),
    *("1:100000000:1rad/s", "1:2/3 1/min", "1:2:1 rad/s**9**9**9"),
)
#: Axes of sweeps with their key, and the scenario.
AXES = (("irefc", "solver.cycles.1=12e3rad/s"), ("parabolic-23-47", "sensor=" + "1" * 5000))
#: Curves from files.
CURVES = (
    "",
    "\n",
    "time\n",
    "time [s], torque [N*m]\n0, 1\n",
    "time [s],torque [N*m]\n0,1\n0,1\n",
    "time [s],torque [N*m]\n1,1\n0,1\n",
    "time [s],torque [N*m]\n0,nan\n1,inf\n",
    "time [s],torque [N*m]\n1e308,1\n-1e308,2\n",
    "time [s],torque [N*m]\n0,1e309\n1,2\n",
    'time [s],"torque\n[N*m]"\n0,1\n1,2\n',
    'time [s],torque [N*m]\n"0\n",1\n1,2\n',
    'time [s],torque [N*m]\n"' + "1" * 200_000 + '",1\n',
    "time [s],torque [N*m]\n" + "1," * 200_000 + "\n",
    "time [rad/s**9**9**9],torque [N*m]\n0,1\n1,2\n",
    "time [" + "s" * 100_000 + "],torque [N*m]\n0,1\n",
    "time [s],torque [N*m]\n0\n",
    "time [s],torque [N*m]\n0,1,2\n",
    "\x00\x00\x00",
    "\ufefftime [s],torque [N*m]\n0,1\n1,2\n",
    "time [s];torque [N*m]\n0;1\n1;2\n",
    "time [s],time [s]\n0,1\n1,2\n",
    "time [s],torque [N*m]\r0,1\r1,2\r",
    "\x1b[31mtime [s],torque [N*m]\n0,1\n1,2\n",
)


def texts() -> Iterator[str]:
    """Whatever may stand as a value on the command line."""
    yield from QUANTITIES
    yield from NUMBERS
    yield from NAMES
    yield from (f'"{text}"' for text in QUANTITIES[:12])
    yield "[" * 3000
    yield "[" * 900 + "]" * 900
    yield "{a=" * 900 + "1" + "}" * 900
    yield '{order = 1, amplitude = "8 um"}'
    yield '[{order = 1e308, amplitude = "1e308 m"}]'
    yield "[]"
    yield "{}"
