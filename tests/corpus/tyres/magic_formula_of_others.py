# SPDX-License-Identifier: Apache-2.0
"""MFeval (the Julia port of M. Furlan's program) run from the text of its repository.

Its functions for pure and combined slip are lines of arithmetic. Their text is fetched, turned into Python by the few
rules below, and run; nothing of it is kept here.
"""
import math
import re
import subprocess

PARTS = ("src/solver/Fx0.jl", "src/solver/Fy0.jl", "src/solver/combined_slip.jl", "src/solver/Mz.jl")
FUNCTIONS = ("calc_Fx0", "calc_Fy0", "calc_Fx", "calc_Fy", "calc_Mz0", "calc_Mz")
# What calls other functions of it, or packs values for them, is done by Model.
# Of the residual moment it takes the cosine of tan(alpha), where Pacejka's book (2012, 4.E47) has that of alpha.
COSINE = ("cos(alpha_star)", "cos(alpha_prime)")
CALLS = re.compile(r"(Fy0_g0, |_, Gyk_g0|ip_nots = |ints = |Mz = if fittyp)")
OLD, NEW = (6, 21), (61, 62)  # FITTYP that it knows


def body(text, name):
    """The lines of a function behind its head."""
    begin = re.search(rf"function {name}\(.*?\)\s*::[^\n]*\n", text, re.S).end()
    lines = []
    for line in text[begin:].split("\n"):
        if re.match(r"^end", line):
            break
        lines.append(line.split("#")[0].rstrip())
    return lines


def joined(lines):
    """One statement a line: a line goes on while brackets are open or an operator ends it."""
    statements, now = [], ""
    for line in lines:
        now = (now + " " + line.strip()) if now else line.strip()
        open_brackets = now.count("(") - now.count(")")
        if now and open_brackets <= 0 and not re.search(r"[-+*/=,?:]\s*$", now):
            statements.append(now)
            now = ""
    return statements


def expression(text):
    text = text.replace(*COSINE)
    text = re.sub(r"\bif (.*?) (.*?) else (.*?) end", r"(\2 if \1 else \3)", text.replace("^", "**"))
    while "?" in text:  # innermost first: a ? b : c
        changed = re.sub(r"\(([^()?]*(?:\([^()]*\))?[^()?]*)\?([^?:]*):([^?:()]*(?:\([^()]*\))?[^?:()]*)\)",
                         r"((\2) if (\1) else (\3))", text)
        if changed == text:
            changed = re.sub(r"=\s*(.*?)\?(.*?):(.*)$", r"= ((\2) if (\1) else (\3))", text)
        if changed == text:
            raise ValueError(text)
        text = changed
    return text.replace("||", " or ").replace("&&", " and ").replace("abs(", "fabs(")


def to_python(text, name):
    out, depth = [f"def {name}(p, pp, ip, modes, sv, pv, iv, Fx0=0.0, Fy0=0.0, muy=0.0, fittyp=61, is_mf52=False, "
                  "fi=None, mz0i=None, Kxk=0.0, Fx=0.0, Fy=0.0, SVyk=0.0, Fy0_g0=0.0, Gyk_g0=0.0):"], 1
    skip = 0
    target = []
    for statement in joined(body(text, name)):
        for piece in [part.strip() for part in statement.split(";") if part.strip()]:
            pad = "    " * depth
            if skip:
                skip += bool(re.match(r"(if|for)\b", piece)) - bool(piece == "end")
                continue
            if re.match(r"if modes\.use_turn_slip$|if ip\.reductionSmooth != 1\.0$", piece):
                skip = 1
            elif re.match(r"if modes\.use_alpha_star && Vcx < 0\.0|if Vcx < 0\.0", piece):
                skip = 1
            elif CALLS.match(piece):
                skip = int(" = if " in piece)
            elif (m := re.match(r"(\w+) = if is_mf52$", piece)):
                target.append(m.group(1))
                out.append(pad + "if is_mf52:")
                depth += 1
            elif piece == "else":
                out.append("    " * (depth - 1) + "else:")
            elif piece == "end" and target:
                target.pop()
                depth -= 1
            elif piece.startswith("fittyp") or piece.startswith("is_mf52") or piece.startswith("zeta2, zeta3"):
                out.append(pad + "zeta2 = zeta3 = 1.0" if piece.startswith("zeta2,") else pad + "pass")
            elif piece.startswith("ip_updated"):
                continue
            elif piece.startswith("return"):
                out.append(pad + "return dict(locals())")
                return "\n".join(out)
            elif target and not re.match(r"\w+\s*=[^=]", piece):
                out.append(pad + f"{target[-1]} = " + expression(piece))
            else:
                out.append(pad + expression(piece))
    raise ValueError(f"{name} has no return")


class Values:
    def __init__(self, values, default=None):
        self.values, self.default = values, default

    def __getattr__(self, name):
        if name in self.values:
            return self.values[name]
        if self.default is None:
            raise AttributeError(name)
        return self.default(name)


class Model:
    def __init__(self, functions, coefficients, fittyp):
        self.functions, self.is_mf52, self.fittyp = functions, fittyp in OLD, fittyp
        scale = lambda name: 1.0 if name.startswith("l") else 0.0
        self.p = Values(coefficients, scale)

    def forces(self, kappa, tan_alpha, camber, load, pressure):
        p = self.p
        fz0 = p.fnomin * p.lfzo
        camber_of_52 = self.is_mf52
        nominal = p.values.get("nompres", 0.0)
        iv = Values({"dfz": (load - fz0) / fz0, "dpi": (pressure - nominal) / nominal if nominal else 0.0})
        modes = Values({}, lambda name: False)
        alpha = math.atan(tan_alpha)
        pv = Values({"Fz0_prime": fz0, "LMUX_prime": p.lmux, "LMUY_prime": p.lmuy, "alpha_prime": alpha})
        ip = Values({"reductionSmooth": 1.0, "zeta2": 1.0}, lambda name: 1e-9)

        def run(name, gamma, **more):
            pp = Values({"Fz": load, "kappa": kappa, "gamma": gamma, "uVcx": 10.0})
            sv = Values({"alpha_star": tan_alpha, "gamma_star": gamma, "LMUX_star": p.lmux, "LMUY_star": p.lmuy})
            return self.functions[name](p, pp, ip, modes, sv, pv, iv, fittyp=self.fittyp, is_mf52=self.is_mf52, **more)

        along = run("calc_Fx0", camber * (p.lgax if camber_of_52 else 1.0))
        across = run("calc_Fy0", camber * (p.lgay if camber_of_52 else 1.0))
        fx = run("calc_Fx", camber, Fx0=along["Fx0"])["Gxa"] * along["Fx0"]
        combined = run("calc_Fy", camber, Fy0=across["Fy0"], muy=across["muy"])
        upright = run("calc_Fy0", 0.0)
        weight = run("calc_Fy", camber, Fy0=upright["Fy0"], muy=upright["muy"])["Gyk"]
        tilt = camber * (p.lgaz if camber_of_52 else 1.0)
        pure = run("calc_Mz0", tilt, fi=Values(across), Fy0_g0=upright["Fy0"])
        moment = run("calc_Mz", tilt, mz0i=Values(pure), Kxk=along["Kxk"], Fx=fx, Fy=combined["Fy"],
                     SVyk=combined["SVyk"], Fy0_g0=upright["Fy0"], Gyk_g0=weight)
        side = combined["Fy"] - combined["SVyk"] if self.is_mf52 else moment["Fy_prime"]
        return fx, combined["Fy"], -moment["t"] * side + moment["Mzr"] + moment["s"] * fx


class Solver:
    def __init__(self, bare, revision):
        text = "".join(subprocess.run(["git", "-C", str(bare), "show", f"{revision}:{part}"], check=True,
                                      capture_output=True, text=True).stdout + "\n" for part in PARTS)
        names = {name: getattr(math, name) for name in ("sin", "cos", "tan", "atan", "exp", "fabs", "sqrt")}
        self.functions = {**names, "min": min, "max": max, "\u03c0": math.pi}
        for name in FUNCTIONS:
            exec(to_python(text, name), self.functions)  # arithmetic of the repository, see above

    def model(self, tir):
        """None for versions that it does not know, and for combined slip by the friction ellipse."""
        values, text = {}, {}
        for line in tir.splitlines():
            line = re.split(r"[$!]", line)[0]
            if "=" in line:
                key, value = (part.strip() for part in line.split("=", 1))
                text.setdefault(key.upper(), value.strip("'\" ").upper())
                try:
                    values.setdefault(key.lower(), float(value))
                except ValueError:
                    continue
        fittyp = int(values.get("fittyp", 6 if text.get("PROPERTY_FILE_FORMAT") == "PAC2002" else 0))
        fittyp = {5: 6, 51: 6, 52: 6}.get(fittyp, fittyp)
        if fittyp not in OLD + NEW or text.get("FE_METHOD") == "YES" or "rbx1" not in values:
            return None
        values.setdefault("pky4", 2.0)
        values.setdefault("nompres", values.get("ip_nom", 220000.0))
        return Model(self.functions, values, fittyp)
