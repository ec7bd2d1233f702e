"""Gradients over coefficients, family 5. Written by ``derive.py``: change that."""

# ruff: noqa
# fmt: off

import numpy as np

from tire_pipeline.magic_formula.jit import jitable
from tire_pipeline.magic_formula.ops import (
    absolute, arctan, cos, exp, log, maximum, minimum, power, select, sin, sqrt,
)
from tire_pipeline.magic_formula.unpacking import unpack

BLOCK = 64
STAMP = "a834fe8ade3b00eb"
OVER = {
    "fx": (
        "FNOMIN",
        "LFZO",
        "LCX",
        "LMUX",
        "LEX",
        "LKX",
        "LHX",
        "LVX",
        "LXAL",
        "LGAX",
        "PCX1",
        "PDX1",
        "PDX2",
        "PDX3",
        "PEX1",
        "PEX2",
        "PEX3",
        "PEX4",
        "PKX1",
        "PKX2",
        "PKX3",
        "PHX1",
        "PHX2",
        "PVX1",
        "PVX2",
        "RBX1",
        "RBX2",
        "RCX1",
        "REX1",
        "REX2",
        "RHX1",
    ),
    "fy": (
        "FNOMIN",
        "LFZO",
        "LCY",
        "LMUY",
        "LEY",
        "LKY",
        "LHY",
        "LVY",
        "LYKA",
        "LVYKA",
        "LGAY",
        "PCY1",
        "PDY1",
        "PDY2",
        "PDY3",
        "PEY1",
        "PEY2",
        "PEY3",
        "PEY4",
        "PKY1",
        "PKY2",
        "PKY3",
        "PHY1",
        "PHY2",
        "PVY1",
        "PVY2",
        "PVY3",
        "PVY4",
        "RBY1",
        "RBY2",
        "RBY3",
        "RCY1",
        "REY1",
        "REY2",
        "RHY1",
        "RHY2",
        "RVY1",
        "RVY2",
        "RVY3",
        "RVY4",
        "RVY5",
        "RVY6",
        "PHY3",
    ),
    "mx": (
        "FNOMIN",
        "UNLOADED_RADIUS",
        "LFZO",
        "LCY",
        "LMUY",
        "LEY",
        "LKY",
        "LHY",
        "LVY",
        "LYKA",
        "LVYKA",
        "LMX",
        "LVMX",
        "LGAY",
        "PCY1",
        "PDY1",
        "PDY2",
        "PDY3",
        "PEY1",
        "PEY2",
        "PEY3",
        "PEY4",
        "PKY1",
        "PKY2",
        "PKY3",
        "PHY1",
        "PHY2",
        "PVY1",
        "PVY2",
        "PVY3",
        "PVY4",
        "RBY1",
        "RBY2",
        "RBY3",
        "RCY1",
        "REY1",
        "REY2",
        "RHY1",
        "RHY2",
        "RVY1",
        "RVY2",
        "RVY3",
        "RVY4",
        "RVY5",
        "RVY6",
        "QSX1",
        "QSX2",
        "QSX3",
        "PHY3",
    ),
    "my": (
        "FNOMIN",
        "UNLOADED_RADIUS",
        "LONGVL",
        "LFZO",
        "LCX",
        "LMUX",
        "LEX",
        "LKX",
        "LHX",
        "LVX",
        "LXAL",
        "LMY",
        "LGAX",
        "PCX1",
        "PDX1",
        "PDX2",
        "PDX3",
        "PEX1",
        "PEX2",
        "PEX3",
        "PEX4",
        "PKX1",
        "PKX2",
        "PKX3",
        "PHX1",
        "PHX2",
        "PVX1",
        "PVX2",
        "RBX1",
        "RBX2",
        "RCX1",
        "REX1",
        "REX2",
        "RHX1",
        "QSY1",
        "QSY2",
        "QSY3",
        "QSY4",
    ),
    "mz": (
        "FNOMIN",
        "UNLOADED_RADIUS",
        "LFZO",
        "LCX",
        "LMUX",
        "LEX",
        "LKX",
        "LHX",
        "LVX",
        "LCY",
        "LMUY",
        "LEY",
        "LKY",
        "LHY",
        "LVY",
        "LTR",
        "LRES",
        "LXAL",
        "LYKA",
        "LVYKA",
        "LS",
        "LGAX",
        "LGAY",
        "LGAZ",
        "PCX1",
        "PDX1",
        "PDX2",
        "PDX3",
        "PEX1",
        "PEX2",
        "PEX3",
        "PEX4",
        "PKX1",
        "PKX2",
        "PKX3",
        "PHX1",
        "PHX2",
        "PVX1",
        "PVX2",
        "PCY1",
        "PDY1",
        "PDY2",
        "PDY3",
        "PEY1",
        "PEY2",
        "PEY3",
        "PEY4",
        "PKY1",
        "PKY2",
        "PKY3",
        "PHY1",
        "PHY2",
        "PVY1",
        "PVY2",
        "PVY3",
        "PVY4",
        "QBZ1",
        "QBZ2",
        "QBZ3",
        "QBZ4",
        "QBZ5",
        "QBZ9",
        "QBZ10",
        "QCZ1",
        "QDZ1",
        "QDZ2",
        "QDZ3",
        "QDZ4",
        "QDZ6",
        "QDZ7",
        "QDZ8",
        "QDZ9",
        "QEZ1",
        "QEZ2",
        "QEZ3",
        "QEZ4",
        "QEZ5",
        "QHZ1",
        "QHZ2",
        "QHZ3",
        "QHZ4",
        "RBX1",
        "RBX2",
        "RCX1",
        "REX1",
        "REX2",
        "RHX1",
        "RBY1",
        "RBY2",
        "RBY3",
        "RCY1",
        "REY1",
        "REY2",
        "RHY1",
        "RHY2",
        "RVY1",
        "RVY2",
        "RVY3",
        "RVY4",
        "RVY5",
        "RVY6",
        "SSZ1",
        "SSZ2",
        "SSZ3",
        "SSZ4",
        "PHY3",
    ),
}


@jitable
def fx(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of fx."""
    t0 = p.FNOMIN * p.LFZO
    t1 = fz - t0
    t2 = t1 / t0
    t3 = gamma * p.LGAX
    t4 = p.PKX2 * t2
    t5 = p.PKX1 + t4
    t6 = fz * t5
    t7 = p.PKX3 * t2
    t8 = maximum(t7, -700.0)
    t9 = minimum(t8, 100.0)
    t10 = exp(t9)
    t11 = t6 * t10
    t12 = t11 * p.LKX
    t13 = p.PDX2 * t2
    t14 = p.PDX1 + t13
    t15 = p.PDX3 * t3
    t16 = t15 * t3
    t17 = 1.0 - t16
    t18 = t14 * t17
    t19 = t18 * p.LMUX
    t20 = p.PHX2 * t2
    t21 = p.PHX1 + t20
    t22 = t21 * p.LHX
    t23 = p.PVX2 * t2
    t24 = p.PVX1 + t23
    t25 = fz * t24
    t26 = t25 * p.LVX
    t27 = t26 * p.LMUX
    t28 = kappa + t22
    t29 = p.PCX1 * p.LCX
    t30 = t19 * fz
    t31 = p.PEX2 * t2
    t32 = p.PEX1 + t31
    t33 = p.PEX3 * t2
    t34 = t33 * t2
    t35 = t32 + t34
    t36 = t28 > 0.0
    t37 = t28 < 0.0
    t38 = select(t37, -1.0, 0.0)
    t39 = select(t36, 1.0, t38)
    t40 = p.PEX4 * t39
    t41 = 1.0 - t40
    t42 = t35 * t41
    t43 = t42 * p.LEX
    t44 = t29 * t30
    t45 = t44 == 0.0
    t46 = select(t45, 1.0, t44)
    t47 = t12 / t46
    t48 = select(t45, 0.0, t47)
    t49 = minimum(t43, 1.0)
    t50 = t48 * t28
    t51 = maximum(t50, -1e+150)
    t52 = minimum(t51, 1e+150)
    t53 = 1.0 - t49
    t54 = t53 * t52
    t55 = arctan(t52)
    t56 = t49 * t55
    t57 = t54 + t56
    t58 = arctan(t57)
    t59 = t29 * t58
    t60 = sin(t59)
    t61 = t30 * t60
    t62 = t61 + t27
    t63 = p.RBX2 * kappa
    t64 = t63 * t63
    t65 = 1.0 + t64
    t66 = sqrt(t65)
    t67 = 1.0 / t66
    t68 = p.RBX1 * t67
    t69 = t68 * p.LXAL
    t70 = p.REX2 * t2
    t71 = p.REX1 + t70
    t72 = minimum(t71, 1.0)
    t73 = alpha + p.RHX1
    t74 = t69 * t73
    t75 = maximum(t74, -1e+150)
    t76 = minimum(t75, 1e+150)
    t77 = 1.0 - t72
    t78 = t77 * t76
    t79 = arctan(t76)
    t80 = t72 * t79
    t81 = t78 + t80
    t82 = arctan(t81)
    t83 = p.RCX1 * t82
    t84 = cos(t83)
    t85 = t69 * p.RHX1
    t86 = maximum(t85, -1e+150)
    t87 = minimum(t86, 1e+150)
    t88 = t77 * t87
    t89 = arctan(t87)
    t90 = t72 * t89
    t91 = t88 + t90
    t92 = arctan(t91)
    t93 = p.RCX1 * t92
    t94 = cos(t93)
    t95 = t94 == 0.0
    t96 = select(t95, 1.0, t94)
    t97 = t84 / t96
    t98 = select(t95, 0.0, t97)
    t99 = select(t95, 0.0, t62)
    t100 = t99 / t96
    t101 = t100 * t97
    t102 = -t101
    t103 = select(t95, 0.0, t102)
    t104 = sin(t93)
    t105 = t103 * t104
    t106 = -t105
    t107 = t106 * t92
    t108 = t106 * p.RCX1
    t109 = t91 * t91
    t110 = 1.0 + t109
    t111 = t108 / t110
    t112 = t111 * t89
    t113 = t111 * t72
    t114 = t87 * t87
    t115 = 1.0 + t114
    t116 = t113 / t115
    t117 = t111 * t87
    t118 = t111 * t77
    t119 = t116 + t118
    t120 = t86 < 1e+150
    t121 = select(t120, t119, 0.0)
    t122 = t85 > -1e+150
    t123 = select(t122, t121, 0.0)
    t124 = t123 * p.RHX1
    t125 = t123 * t69
    t126 = sin(t83)
    t127 = t100 * t126
    t128 = -t127
    t129 = t128 * t82
    t130 = t128 * p.RCX1
    t131 = t107 + t129
    t132 = t81 * t81
    t133 = 1.0 + t132
    t134 = t130 / t133
    t135 = t134 * t79
    t136 = t134 * t72
    t137 = t112 + t135
    t138 = t76 * t76
    t139 = 1.0 + t138
    t140 = t136 / t139
    t141 = t134 * t76
    t142 = t134 * t77
    t143 = t117 + t141
    t144 = t140 + t142
    t145 = -t143
    t146 = t137 + t145
    t147 = t75 < 1e+150
    t148 = select(t147, t144, 0.0)
    t149 = t74 > -1e+150
    t150 = select(t149, t148, 0.0)
    t151 = t150 * t73
    t152 = t150 * t69
    t153 = t124 + t151
    t154 = t125 + t152
    t155 = t71 < 1.0
    t156 = select(t155, t146, 0.0)
    t157 = t156 * t2
    t158 = t156 * p.REX2
    t159 = t153 * p.LXAL
    t160 = t153 * t68
    t161 = t159 * t67
    t162 = t159 * p.RBX1
    t163 = t162 / t66
    t164 = t163 * t67
    t165 = -t164
    t166 = t66 == 0.0
    t167 = 0.5 * t165
    t168 = t167 / t66
    t169 = select(t166, 0.0, t168)
    t170 = t169 * t63
    t171 = t170 + t170
    t172 = t171 * kappa
    t173 = t98 * t60
    t174 = t98 * t30
    t175 = cos(t59)
    t176 = t174 * t175
    t177 = t176 * t58
    t178 = t176 * t29
    t179 = t57 * t57
    t180 = 1.0 + t179
    t181 = t178 / t180
    t182 = t181 * t55
    t183 = t181 * t49
    t184 = t52 * t52
    t185 = 1.0 + t184
    t186 = t183 / t185
    t187 = t181 * t52
    t188 = t181 * t53
    t189 = t186 + t188
    t190 = -t187
    t191 = t182 + t190
    t192 = t51 < 1e+150
    t193 = select(t192, t189, 0.0)
    t194 = t50 > -1e+150
    t195 = select(t194, t193, 0.0)
    t196 = t195 * t28
    t197 = t195 * t48
    t198 = t43 < 1.0
    t199 = select(t198, t191, 0.0)
    t200 = select(t45, 0.0, t196)
    t201 = t200 / t46
    t202 = t201 * t47
    t203 = -t202
    t204 = select(t45, 0.0, t203)
    t205 = t204 * t30
    t206 = t204 * t29
    t207 = t177 + t205
    t208 = t173 + t206
    t209 = t199 * p.LEX
    t210 = t199 * t42
    t211 = t209 * t41
    t212 = t209 * t35
    t213 = -t212
    t214 = t213 * t39
    t215 = t211 * t2
    t216 = t211 * t33
    t217 = t158 + t216
    t218 = t215 * t2
    t219 = t215 * p.PEX3
    t220 = t217 + t219
    t221 = t211 * p.PEX2
    t222 = t220 + t221
    t223 = t208 * fz
    t224 = t207 * p.LCX
    t225 = t207 * p.PCX1
    t226 = t98 * p.LMUX
    t227 = t98 * t26
    t228 = t226 * p.LVX
    t229 = t226 * t25
    t230 = t228 * fz
    t231 = t230 * t2
    t232 = t230 * p.PVX2
    t233 = t222 + t232
    t234 = t197 * p.LHX
    t235 = t197 * t21
    t236 = t234 * t2
    t237 = t234 * p.PHX2
    t238 = t233 + t237
    t239 = t223 * p.LMUX
    t240 = t223 * t18
    t241 = t227 + t240
    t242 = t239 * t17
    t243 = t239 * t14
    t244 = -t243
    t245 = t244 * t3
    t246 = t244 * t15
    t247 = t245 * t3
    t248 = t245 * p.PDX3
    t249 = t246 + t248
    t250 = t242 * t2
    t251 = t242 * p.PDX2
    t252 = t238 + t251
    t253 = t201 * p.LKX
    t254 = t201 * t11
    t255 = t253 * t10
    t256 = t253 * t6
    t257 = t256 * t10
    t258 = t8 < 100.0
    t259 = select(t258, t257, 0.0)
    t260 = t7 > -700.0
    t261 = select(t260, t259, 0.0)
    t262 = t261 * t2
    t263 = t261 * p.PKX3
    t264 = t252 + t263
    t265 = t255 * fz
    t266 = t265 * t2
    t267 = t265 * p.PKX2
    t268 = t264 + t267
    t269 = t249 * gamma
    t270 = t268 / t0
    t271 = t270 * t2
    t272 = -t271
    t273 = -t270
    t274 = t272 + t273
    t275 = t274 * p.LFZO
    t276 = t274 * p.FNOMIN
    return (
        t275,
        t276,
        t225,
        t241,
        t210,
        t254,
        t235,
        t229,
        t160,
        t269,
        t224,
        t242,
        t250,
        t247,
        t211,
        t215,
        t218,
        t214,
        t265,
        t266,
        t262,
        t234,
        t236,
        t230,
        t231,
        t161,
        t172,
        t131,
        t156,
        t157,
        t154,
    )


def loop_fx(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of fx; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(37 * BLOCK)
    for start in range(0, out.shape[1], BLOCK):
        m = min(BLOCK, out.shape[1] - start)
        for i in range(m):
            w[0 * BLOCK + i] = alpha[start + i]
            w[1 * BLOCK + i] = kappa[start + i]
            w[2 * BLOCK + i] = gamma[start + i]
            w[3 * BLOCK + i] = fz[start + i]
            w[4 * BLOCK + i] = speed[start + i]
            w[5 * BLOCK + i] = dpi[start + i]
        for i in range(m):
            g = fx(p, w[0 * BLOCK + i], w[1 * BLOCK + i], w[2 * BLOCK + i], w[3 * BLOCK + i], w[4 * BLOCK + i], w[5 * BLOCK + i])
            w[6 * BLOCK + i] = g[0]
            w[7 * BLOCK + i] = g[1]
            w[8 * BLOCK + i] = g[2]
            w[9 * BLOCK + i] = g[3]
            w[10 * BLOCK + i] = g[4]
            w[11 * BLOCK + i] = g[5]
            w[12 * BLOCK + i] = g[6]
            w[13 * BLOCK + i] = g[7]
            w[14 * BLOCK + i] = g[8]
            w[15 * BLOCK + i] = g[9]
            w[16 * BLOCK + i] = g[10]
            w[17 * BLOCK + i] = g[11]
            w[18 * BLOCK + i] = g[12]
            w[19 * BLOCK + i] = g[13]
            w[20 * BLOCK + i] = g[14]
            w[21 * BLOCK + i] = g[15]
            w[22 * BLOCK + i] = g[16]
            w[23 * BLOCK + i] = g[17]
            w[24 * BLOCK + i] = g[18]
            w[25 * BLOCK + i] = g[19]
            w[26 * BLOCK + i] = g[20]
            w[27 * BLOCK + i] = g[21]
            w[28 * BLOCK + i] = g[22]
            w[29 * BLOCK + i] = g[23]
            w[30 * BLOCK + i] = g[24]
            w[31 * BLOCK + i] = g[25]
            w[32 * BLOCK + i] = g[26]
            w[33 * BLOCK + i] = g[27]
            w[34 * BLOCK + i] = g[28]
            w[35 * BLOCK + i] = g[29]
            w[36 * BLOCK + i] = g[30]
        for k in range(31):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]


@jitable
def fy(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of fy."""
    t0 = p.FNOMIN * p.LFZO
    t1 = fz - t0
    t2 = t1 / t0
    t3 = gamma * p.LGAY
    t4 = p.PKY1 * t0
    t5 = p.PKY2 * t0
    t6 = t5 == 0.0
    t7 = select(t6, 1.0, t5)
    t8 = fz / t7
    t9 = select(t6, 0.0, t8)
    t10 = 2.0 * t9
    t11 = t9 * t9
    t12 = 1.0 + t11
    t13 = t10 / t12
    t14 = t4 * t13
    t15 = absolute(t3)
    t16 = p.PKY3 * t15
    t17 = 1.0 - t16
    t18 = t14 * t17
    t19 = t18 * p.LKY
    t20 = p.PDY2 * t2
    t21 = p.PDY1 + t20
    t22 = p.PDY3 * t3
    t23 = t22 * t3
    t24 = 1.0 - t23
    t25 = t21 * t24
    t26 = t25 * p.LMUY
    t27 = p.PHY2 * t2
    t28 = p.PHY1 + t27
    t29 = t28 * p.LHY
    t30 = p.PHY3 * t3
    t31 = t29 + t30
    t32 = p.PVY2 * t2
    t33 = p.PVY1 + t32
    t34 = t33 * p.LVY
    t35 = p.PVY4 * t2
    t36 = p.PVY3 + t35
    t37 = t36 * t3
    t38 = t34 + t37
    t39 = fz * t38
    t40 = t39 * p.LMUY
    t41 = alpha + t31
    t42 = p.PCY1 * p.LCY
    t43 = t26 * fz
    t44 = p.PEY2 * t2
    t45 = p.PEY1 + t44
    t46 = p.PEY4 * t3
    t47 = p.PEY3 + t46
    t48 = t41 > 0.0
    t49 = t41 < 0.0
    t50 = select(t49, -1.0, 0.0)
    t51 = select(t48, 1.0, t50)
    t52 = t47 * t51
    t53 = 1.0 - t52
    t54 = t45 * t53
    t55 = t54 * p.LEY
    t56 = t42 * t43
    t57 = t56 == 0.0
    t58 = select(t57, 1.0, t56)
    t59 = t19 / t58
    t60 = select(t57, 0.0, t59)
    t61 = minimum(t55, 1.0)
    t62 = t60 * t41
    t63 = maximum(t62, -1e+150)
    t64 = minimum(t63, 1e+150)
    t65 = 1.0 - t61
    t66 = t65 * t64
    t67 = arctan(t64)
    t68 = t61 * t67
    t69 = t66 + t68
    t70 = arctan(t69)
    t71 = t42 * t70
    t72 = sin(t71)
    t73 = t43 * t72
    t74 = t73 + t40
    t75 = alpha - p.RBY3
    t76 = p.RBY2 * t75
    t77 = t76 * t76
    t78 = 1.0 + t77
    t79 = sqrt(t78)
    t80 = 1.0 / t79
    t81 = p.RBY1 * t80
    t82 = t81 * p.LYKA
    t83 = p.REY2 * t2
    t84 = p.REY1 + t83
    t85 = minimum(t84, 1.0)
    t86 = p.RHY2 * t2
    t87 = p.RHY1 + t86
    t88 = p.RVY2 * t2
    t89 = p.RVY1 + t88
    t90 = p.RVY3 * gamma
    t91 = t89 + t90
    t92 = t43 * t91
    t93 = p.RVY4 * alpha
    t94 = t93 * t93
    t95 = 1.0 + t94
    t96 = sqrt(t95)
    t97 = 1.0 / t96
    t98 = t92 * t97
    t99 = p.RVY6 * kappa
    t100 = arctan(t99)
    t101 = p.RVY5 * t100
    t102 = sin(t101)
    t103 = t98 * t102
    t104 = kappa + t87
    t105 = t82 * t104
    t106 = maximum(t105, -1e+150)
    t107 = minimum(t106, 1e+150)
    t108 = 1.0 - t85
    t109 = t108 * t107
    t110 = arctan(t107)
    t111 = t85 * t110
    t112 = t109 + t111
    t113 = arctan(t112)
    t114 = p.RCY1 * t113
    t115 = cos(t114)
    t116 = t82 * t87
    t117 = maximum(t116, -1e+150)
    t118 = minimum(t117, 1e+150)
    t119 = t108 * t118
    t120 = arctan(t118)
    t121 = t85 * t120
    t122 = t119 + t121
    t123 = arctan(t122)
    t124 = p.RCY1 * t123
    t125 = cos(t124)
    t126 = t125 == 0.0
    t127 = select(t126, 1.0, t125)
    t128 = t115 / t127
    t129 = select(t126, 0.0, t128)
    t130 = select(t126, 0.0, t74)
    t131 = t130 / t127
    t132 = t131 * t128
    t133 = -t132
    t134 = select(t126, 0.0, t133)
    t135 = sin(t124)
    t136 = t134 * t135
    t137 = -t136
    t138 = t137 * t123
    t139 = t137 * p.RCY1
    t140 = t122 * t122
    t141 = 1.0 + t140
    t142 = t139 / t141
    t143 = t142 * t120
    t144 = t142 * t85
    t145 = t118 * t118
    t146 = 1.0 + t145
    t147 = t144 / t146
    t148 = t142 * t118
    t149 = t142 * t108
    t150 = t147 + t149
    t151 = t117 < 1e+150
    t152 = select(t151, t150, 0.0)
    t153 = t116 > -1e+150
    t154 = select(t153, t152, 0.0)
    t155 = t154 * t87
    t156 = t154 * t82
    t157 = sin(t114)
    t158 = t131 * t157
    t159 = -t158
    t160 = t159 * t113
    t161 = t159 * p.RCY1
    t162 = t138 + t160
    t163 = t112 * t112
    t164 = 1.0 + t163
    t165 = t161 / t164
    t166 = t165 * t110
    t167 = t165 * t85
    t168 = t143 + t166
    t169 = t107 * t107
    t170 = 1.0 + t169
    t171 = t167 / t170
    t172 = t165 * t107
    t173 = t165 * t108
    t174 = t148 + t172
    t175 = t171 + t173
    t176 = -t174
    t177 = t168 + t176
    t178 = t106 < 1e+150
    t179 = select(t178, t175, 0.0)
    t180 = t105 > -1e+150
    t181 = select(t180, t179, 0.0)
    t182 = t181 * t104
    t183 = t181 * t82
    t184 = t155 + t182
    t185 = t156 + t183
    t186 = p.LVYKA * t102
    t187 = p.LVYKA * t98
    t188 = cos(t101)
    t189 = t187 * t188
    t190 = t189 * t100
    t191 = t189 * p.RVY5
    t192 = t99 * t99
    t193 = 1.0 + t192
    t194 = t191 / t193
    t195 = t194 * kappa
    t196 = t186 * t97
    t197 = t186 * t92
    t198 = t197 / t96
    t199 = t198 * t97
    t200 = -t199
    t201 = t96 == 0.0
    t202 = 0.5 * t200
    t203 = t202 / t96
    t204 = select(t201, 0.0, t203)
    t205 = t204 * t93
    t206 = t205 + t205
    t207 = t206 * alpha
    t208 = t196 * t91
    t209 = t196 * t43
    t210 = t209 * gamma
    t211 = t209 * t2
    t212 = t209 * p.RVY2
    t213 = t185 * t2
    t214 = t185 * p.RHY2
    t215 = t212 + t214
    t216 = t84 < 1.0
    t217 = select(t216, t177, 0.0)
    t218 = t217 * t2
    t219 = t217 * p.REY2
    t220 = t215 + t219
    t221 = t184 * p.LYKA
    t222 = t184 * t81
    t223 = t221 * t80
    t224 = t221 * p.RBY1
    t225 = t224 / t79
    t226 = t225 * t80
    t227 = -t226
    t228 = t79 == 0.0
    t229 = 0.5 * t227
    t230 = t229 / t79
    t231 = select(t228, 0.0, t230)
    t232 = t231 * t76
    t233 = t232 + t232
    t234 = t233 * t75
    t235 = t233 * p.RBY2
    t236 = -t235
    t237 = t129 * t72
    t238 = t129 * t43
    t239 = t208 + t237
    t240 = cos(t71)
    t241 = t238 * t240
    t242 = t241 * t70
    t243 = t241 * t42
    t244 = t69 * t69
    t245 = 1.0 + t244
    t246 = t243 / t245
    t247 = t246 * t67
    t248 = t246 * t61
    t249 = t64 * t64
    t250 = 1.0 + t249
    t251 = t248 / t250
    t252 = t246 * t64
    t253 = t246 * t65
    t254 = t251 + t253
    t255 = -t252
    t256 = t247 + t255
    t257 = t63 < 1e+150
    t258 = select(t257, t254, 0.0)
    t259 = t62 > -1e+150
    t260 = select(t259, t258, 0.0)
    t261 = t260 * t41
    t262 = t260 * t60
    t263 = t55 < 1.0
    t264 = select(t263, t256, 0.0)
    t265 = select(t57, 0.0, t261)
    t266 = t265 / t58
    t267 = t266 * t59
    t268 = -t267
    t269 = select(t57, 0.0, t268)
    t270 = t269 * t43
    t271 = t269 * t42
    t272 = t242 + t270
    t273 = t239 + t271
    t274 = t264 * p.LEY
    t275 = t264 * t54
    t276 = t274 * t53
    t277 = t274 * t45
    t278 = -t277
    t279 = t278 * t51
    t280 = t279 * t3
    t281 = t279 * p.PEY4
    t282 = t276 * t2
    t283 = t276 * p.PEY2
    t284 = t220 + t283
    t285 = t273 * fz
    t286 = t272 * p.LCY
    t287 = t272 * p.PCY1
    t288 = t129 * p.LMUY
    t289 = t129 * t39
    t290 = t288 * fz
    t291 = t290 * t3
    t292 = t290 * t36
    t293 = t281 + t292
    t294 = t291 * t2
    t295 = t291 * p.PVY4
    t296 = t284 + t295
    t297 = t290 * p.LVY
    t298 = t290 * t33
    t299 = t297 * t2
    t300 = t297 * p.PVY2
    t301 = t296 + t300
    t302 = t262 * t3
    t303 = t262 * p.PHY3
    t304 = t293 + t303
    t305 = t262 * p.LHY
    t306 = t262 * t28
    t307 = t305 * t2
    t308 = t305 * p.PHY2
    t309 = t301 + t308
    t310 = t285 * p.LMUY
    t311 = t285 * t25
    t312 = t289 + t311
    t313 = t310 * t24
    t314 = t310 * t21
    t315 = -t314
    t316 = t315 * t3
    t317 = t315 * t22
    t318 = t304 + t317
    t319 = t316 * t3
    t320 = t316 * p.PDY3
    t321 = t318 + t320
    t322 = t313 * t2
    t323 = t313 * p.PDY2
    t324 = t309 + t323
    t325 = t266 * p.LKY
    t326 = t266 * t18
    t327 = t325 * t17
    t328 = t325 * t14
    t329 = -t328
    t330 = t329 * t15
    t331 = t329 * p.PKY3
    t332 = t3 < 0.0
    t333 = -t331
    t334 = select(t332, t333, t331)
    t335 = t321 + t334
    t336 = t327 * t13
    t337 = t327 * t4
    t338 = t337 / t12
    t339 = t338 * t13
    t340 = -t339
    t341 = t340 * t9
    t342 = t341 + t341
    t343 = t338 * 2.0
    t344 = t342 + t343
    t345 = select(t6, 0.0, t344)
    t346 = t345 / t7
    t347 = t346 * t8
    t348 = -t347
    t349 = select(t6, 0.0, t348)
    t350 = t349 * t0
    t351 = t349 * p.PKY2
    t352 = t336 * t0
    t353 = t336 * p.PKY1
    t354 = t351 + t353
    t355 = t335 * gamma
    t356 = t324 / t0
    t357 = t356 * t2
    t358 = -t357
    t359 = t354 + t358
    t360 = -t356
    t361 = t359 + t360
    t362 = t361 * p.LFZO
    t363 = t361 * p.FNOMIN
    return (
        t362,
        t363,
        t287,
        t312,
        t275,
        t326,
        t306,
        t298,
        t222,
        t103,
        t355,
        t286,
        t313,
        t322,
        t319,
        t276,
        t282,
        t279,
        t280,
        t352,
        t350,
        t330,
        t305,
        t307,
        t297,
        t299,
        t291,
        t294,
        t223,
        t234,
        t236,
        t162,
        t217,
        t218,
        t185,
        t213,
        t209,
        t211,
        t210,
        t207,
        t190,
        t195,
        t302,
    )


def loop_fy(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of fy; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(49 * BLOCK)
    for start in range(0, out.shape[1], BLOCK):
        m = min(BLOCK, out.shape[1] - start)
        for i in range(m):
            w[0 * BLOCK + i] = alpha[start + i]
            w[1 * BLOCK + i] = kappa[start + i]
            w[2 * BLOCK + i] = gamma[start + i]
            w[3 * BLOCK + i] = fz[start + i]
            w[4 * BLOCK + i] = speed[start + i]
            w[5 * BLOCK + i] = dpi[start + i]
        for i in range(m):
            g = fy(p, w[0 * BLOCK + i], w[1 * BLOCK + i], w[2 * BLOCK + i], w[3 * BLOCK + i], w[4 * BLOCK + i], w[5 * BLOCK + i])
            w[6 * BLOCK + i] = g[0]
            w[7 * BLOCK + i] = g[1]
            w[8 * BLOCK + i] = g[2]
            w[9 * BLOCK + i] = g[3]
            w[10 * BLOCK + i] = g[4]
            w[11 * BLOCK + i] = g[5]
            w[12 * BLOCK + i] = g[6]
            w[13 * BLOCK + i] = g[7]
            w[14 * BLOCK + i] = g[8]
            w[15 * BLOCK + i] = g[9]
            w[16 * BLOCK + i] = g[10]
            w[17 * BLOCK + i] = g[11]
            w[18 * BLOCK + i] = g[12]
            w[19 * BLOCK + i] = g[13]
            w[20 * BLOCK + i] = g[14]
            w[21 * BLOCK + i] = g[15]
            w[22 * BLOCK + i] = g[16]
            w[23 * BLOCK + i] = g[17]
            w[24 * BLOCK + i] = g[18]
            w[25 * BLOCK + i] = g[19]
            w[26 * BLOCK + i] = g[20]
            w[27 * BLOCK + i] = g[21]
            w[28 * BLOCK + i] = g[22]
            w[29 * BLOCK + i] = g[23]
            w[30 * BLOCK + i] = g[24]
            w[31 * BLOCK + i] = g[25]
            w[32 * BLOCK + i] = g[26]
            w[33 * BLOCK + i] = g[27]
            w[34 * BLOCK + i] = g[28]
            w[35 * BLOCK + i] = g[29]
            w[36 * BLOCK + i] = g[30]
            w[37 * BLOCK + i] = g[31]
            w[38 * BLOCK + i] = g[32]
            w[39 * BLOCK + i] = g[33]
            w[40 * BLOCK + i] = g[34]
            w[41 * BLOCK + i] = g[35]
            w[42 * BLOCK + i] = g[36]
            w[43 * BLOCK + i] = g[37]
            w[44 * BLOCK + i] = g[38]
            w[45 * BLOCK + i] = g[39]
            w[46 * BLOCK + i] = g[40]
            w[47 * BLOCK + i] = g[41]
            w[48 * BLOCK + i] = g[42]
        for k in range(43):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]


@jitable
def mx(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of mx."""
    t0 = p.FNOMIN * p.LFZO
    t1 = fz - t0
    t2 = t1 / t0
    t3 = gamma * p.LGAY
    t4 = p.PKY1 * t0
    t5 = p.PKY2 * t0
    t6 = t5 == 0.0
    t7 = select(t6, 1.0, t5)
    t8 = fz / t7
    t9 = select(t6, 0.0, t8)
    t10 = 2.0 * t9
    t11 = t9 * t9
    t12 = 1.0 + t11
    t13 = t10 / t12
    t14 = t4 * t13
    t15 = absolute(t3)
    t16 = p.PKY3 * t15
    t17 = 1.0 - t16
    t18 = t14 * t17
    t19 = t18 * p.LKY
    t20 = p.PDY2 * t2
    t21 = p.PDY1 + t20
    t22 = p.PDY3 * t3
    t23 = t22 * t3
    t24 = 1.0 - t23
    t25 = t21 * t24
    t26 = t25 * p.LMUY
    t27 = p.PHY2 * t2
    t28 = p.PHY1 + t27
    t29 = t28 * p.LHY
    t30 = p.PHY3 * t3
    t31 = t29 + t30
    t32 = p.PVY2 * t2
    t33 = p.PVY1 + t32
    t34 = t33 * p.LVY
    t35 = p.PVY4 * t2
    t36 = p.PVY3 + t35
    t37 = t36 * t3
    t38 = t34 + t37
    t39 = fz * t38
    t40 = t39 * p.LMUY
    t41 = alpha + t31
    t42 = p.PCY1 * p.LCY
    t43 = t26 * fz
    t44 = p.PEY2 * t2
    t45 = p.PEY1 + t44
    t46 = p.PEY4 * t3
    t47 = p.PEY3 + t46
    t48 = t41 > 0.0
    t49 = t41 < 0.0
    t50 = select(t49, -1.0, 0.0)
    t51 = select(t48, 1.0, t50)
    t52 = t47 * t51
    t53 = 1.0 - t52
    t54 = t45 * t53
    t55 = t54 * p.LEY
    t56 = t42 * t43
    t57 = t56 == 0.0
    t58 = select(t57, 1.0, t56)
    t59 = t19 / t58
    t60 = select(t57, 0.0, t59)
    t61 = minimum(t55, 1.0)
    t62 = t60 * t41
    t63 = maximum(t62, -1e+150)
    t64 = minimum(t63, 1e+150)
    t65 = 1.0 - t61
    t66 = t65 * t64
    t67 = arctan(t64)
    t68 = t61 * t67
    t69 = t66 + t68
    t70 = arctan(t69)
    t71 = t42 * t70
    t72 = sin(t71)
    t73 = t43 * t72
    t74 = t73 + t40
    t75 = alpha - p.RBY3
    t76 = p.RBY2 * t75
    t77 = t76 * t76
    t78 = 1.0 + t77
    t79 = sqrt(t78)
    t80 = 1.0 / t79
    t81 = p.RBY1 * t80
    t82 = t81 * p.LYKA
    t83 = p.REY2 * t2
    t84 = p.REY1 + t83
    t85 = minimum(t84, 1.0)
    t86 = p.RHY2 * t2
    t87 = p.RHY1 + t86
    t88 = p.RVY2 * t2
    t89 = p.RVY1 + t88
    t90 = p.RVY3 * gamma
    t91 = t89 + t90
    t92 = t43 * t91
    t93 = p.RVY4 * alpha
    t94 = t93 * t93
    t95 = 1.0 + t94
    t96 = sqrt(t95)
    t97 = 1.0 / t96
    t98 = t92 * t97
    t99 = p.RVY6 * kappa
    t100 = arctan(t99)
    t101 = p.RVY5 * t100
    t102 = sin(t101)
    t103 = t98 * t102
    t104 = t103 * p.LVYKA
    t105 = kappa + t87
    t106 = t82 * t105
    t107 = maximum(t106, -1e+150)
    t108 = minimum(t107, 1e+150)
    t109 = 1.0 - t85
    t110 = t109 * t108
    t111 = arctan(t108)
    t112 = t85 * t111
    t113 = t110 + t112
    t114 = arctan(t113)
    t115 = p.RCY1 * t114
    t116 = cos(t115)
    t117 = t82 * t87
    t118 = maximum(t117, -1e+150)
    t119 = minimum(t118, 1e+150)
    t120 = t109 * t119
    t121 = arctan(t119)
    t122 = t85 * t121
    t123 = t120 + t122
    t124 = arctan(t123)
    t125 = p.RCY1 * t124
    t126 = cos(t125)
    t127 = t126 == 0.0
    t128 = select(t127, 1.0, t126)
    t129 = t116 / t128
    t130 = select(t127, 0.0, t129)
    t131 = t74 * t130
    t132 = t131 + t104
    t133 = p.UNLOADED_RADIUS * fz
    t134 = p.QSX1 * p.LVMX
    t135 = -p.QSX2
    t136 = t135 * gamma
    t137 = p.QSX3 * t132
    t138 = t137 / p.FNOMIN
    t139 = t136 + t138
    t140 = t139 * p.LMX
    t141 = t134 + t140
    t142 = sin(t125)
    t143 = t123 * t123
    t144 = 1.0 + t143
    t145 = t119 * t119
    t146 = 1.0 + t145
    t147 = t118 < 1e+150
    t148 = t117 > -1e+150
    t149 = sin(t115)
    t150 = t113 * t113
    t151 = 1.0 + t150
    t152 = t108 * t108
    t153 = 1.0 + t152
    t154 = t107 < 1e+150
    t155 = t106 > -1e+150
    t156 = cos(t101)
    t157 = t99 * t99
    t158 = 1.0 + t157
    t159 = t96 == 0.0
    t160 = t84 < 1.0
    t161 = t79 == 0.0
    t162 = cos(t71)
    t163 = t69 * t69
    t164 = 1.0 + t163
    t165 = t64 * t64
    t166 = 1.0 + t165
    t167 = t63 < 1e+150
    t168 = t62 > -1e+150
    t169 = t55 < 1.0
    t170 = t3 < 0.0
    t171 = t133 * p.LMX
    t172 = t133 * t139
    t173 = t171 / p.FNOMIN
    t174 = t173 * t138
    t175 = -t174
    t176 = t173 * t132
    t177 = t173 * p.QSX3
    t178 = t171 * gamma
    t179 = -t178
    t180 = t133 * p.LVMX
    t181 = t133 * p.QSX1
    t182 = t141 * fz
    t183 = t177 * t130
    t184 = t177 * t74
    t185 = select(t127, 0.0, t184)
    t186 = t185 / t128
    t187 = t186 * t129
    t188 = -t187
    t189 = select(t127, 0.0, t188)
    t190 = t189 * t142
    t191 = -t190
    t192 = t191 * t124
    t193 = t191 * p.RCY1
    t194 = t193 / t144
    t195 = t194 * t121
    t196 = t194 * t85
    t197 = t196 / t146
    t198 = t194 * t119
    t199 = t194 * t109
    t200 = t197 + t199
    t201 = select(t147, t200, 0.0)
    t202 = select(t148, t201, 0.0)
    t203 = t202 * t87
    t204 = t202 * t82
    t205 = t186 * t149
    t206 = -t205
    t207 = t206 * t114
    t208 = t206 * p.RCY1
    t209 = t192 + t207
    t210 = t208 / t151
    t211 = t210 * t111
    t212 = t210 * t85
    t213 = t195 + t211
    t214 = t212 / t153
    t215 = t210 * t108
    t216 = t210 * t109
    t217 = t198 + t215
    t218 = t214 + t216
    t219 = -t217
    t220 = t213 + t219
    t221 = select(t154, t218, 0.0)
    t222 = select(t155, t221, 0.0)
    t223 = t222 * t105
    t224 = t222 * t82
    t225 = t203 + t223
    t226 = t204 + t224
    t227 = t177 * p.LVYKA
    t228 = t177 * t103
    t229 = t227 * t102
    t230 = t227 * t98
    t231 = t230 * t156
    t232 = t231 * t100
    t233 = t231 * p.RVY5
    t234 = t233 / t158
    t235 = t234 * kappa
    t236 = t229 * t97
    t237 = t229 * t92
    t238 = t237 / t96
    t239 = t238 * t97
    t240 = -t239
    t241 = 0.5 * t240
    t242 = t241 / t96
    t243 = select(t159, 0.0, t242)
    t244 = t243 * t93
    t245 = t244 + t244
    t246 = t245 * alpha
    t247 = t236 * t91
    t248 = t236 * t43
    t249 = t248 * gamma
    t250 = t248 * t2
    t251 = t248 * p.RVY2
    t252 = t226 * t2
    t253 = t226 * p.RHY2
    t254 = t251 + t253
    t255 = select(t160, t220, 0.0)
    t256 = t255 * t2
    t257 = t255 * p.REY2
    t258 = t254 + t257
    t259 = t225 * p.LYKA
    t260 = t225 * t81
    t261 = t259 * t80
    t262 = t259 * p.RBY1
    t263 = t262 / t79
    t264 = t263 * t80
    t265 = -t264
    t266 = 0.5 * t265
    t267 = t266 / t79
    t268 = select(t161, 0.0, t267)
    t269 = t268 * t76
    t270 = t269 + t269
    t271 = t270 * t75
    t272 = t270 * p.RBY2
    t273 = -t272
    t274 = t183 * t72
    t275 = t183 * t43
    t276 = t247 + t274
    t277 = t275 * t162
    t278 = t277 * t70
    t279 = t277 * t42
    t280 = t279 / t164
    t281 = t280 * t67
    t282 = t280 * t61
    t283 = t282 / t166
    t284 = t280 * t64
    t285 = t280 * t65
    t286 = t283 + t285
    t287 = -t284
    t288 = t281 + t287
    t289 = select(t167, t286, 0.0)
    t290 = select(t168, t289, 0.0)
    t291 = t290 * t41
    t292 = t290 * t60
    t293 = select(t169, t288, 0.0)
    t294 = select(t57, 0.0, t291)
    t295 = t294 / t58
    t296 = t295 * t59
    t297 = -t296
    t298 = select(t57, 0.0, t297)
    t299 = t298 * t43
    t300 = t298 * t42
    t301 = t278 + t299
    t302 = t276 + t300
    t303 = t293 * p.LEY
    t304 = t293 * t54
    t305 = t303 * t53
    t306 = t303 * t45
    t307 = -t306
    t308 = t307 * t51
    t309 = t308 * t3
    t310 = t308 * p.PEY4
    t311 = t305 * t2
    t312 = t305 * p.PEY2
    t313 = t258 + t312
    t314 = t302 * fz
    t315 = t301 * p.LCY
    t316 = t301 * p.PCY1
    t317 = t183 * p.LMUY
    t318 = t183 * t39
    t319 = t317 * fz
    t320 = t319 * t3
    t321 = t319 * t36
    t322 = t310 + t321
    t323 = t320 * t2
    t324 = t320 * p.PVY4
    t325 = t313 + t324
    t326 = t319 * p.LVY
    t327 = t319 * t33
    t328 = t326 * t2
    t329 = t326 * p.PVY2
    t330 = t325 + t329
    t331 = t292 * t3
    t332 = t292 * p.PHY3
    t333 = t322 + t332
    t334 = t292 * p.LHY
    t335 = t292 * t28
    t336 = t334 * t2
    t337 = t334 * p.PHY2
    t338 = t330 + t337
    t339 = t314 * p.LMUY
    t340 = t314 * t25
    t341 = t318 + t340
    t342 = t339 * t24
    t343 = t339 * t21
    t344 = -t343
    t345 = t344 * t3
    t346 = t344 * t22
    t347 = t333 + t346
    t348 = t345 * t3
    t349 = t345 * p.PDY3
    t350 = t347 + t349
    t351 = t342 * t2
    t352 = t342 * p.PDY2
    t353 = t338 + t352
    t354 = t295 * p.LKY
    t355 = t295 * t18
    t356 = t354 * t17
    t357 = t354 * t14
    t358 = -t357
    t359 = t358 * t15
    t360 = t358 * p.PKY3
    t361 = -t360
    t362 = select(t170, t361, t360)
    t363 = t350 + t362
    t364 = t356 * t13
    t365 = t356 * t4
    t366 = t365 / t12
    t367 = t366 * t13
    t368 = -t367
    t369 = t368 * t9
    t370 = t369 + t369
    t371 = t366 * 2.0
    t372 = t370 + t371
    t373 = select(t6, 0.0, t372)
    t374 = t373 / t7
    t375 = t374 * t8
    t376 = -t375
    t377 = select(t6, 0.0, t376)
    t378 = t377 * t0
    t379 = t377 * p.PKY2
    t380 = t364 * t0
    t381 = t364 * p.PKY1
    t382 = t379 + t381
    t383 = t363 * gamma
    t384 = t353 / t0
    t385 = t384 * t2
    t386 = -t385
    t387 = t382 + t386
    t388 = -t384
    t389 = t387 + t388
    t390 = t389 * p.LFZO
    t391 = t389 * p.FNOMIN
    t392 = t175 + t390
    return (
        t392,
        t182,
        t391,
        t316,
        t341,
        t304,
        t355,
        t335,
        t327,
        t260,
        t228,
        t172,
        t181,
        t383,
        t315,
        t342,
        t351,
        t348,
        t305,
        t311,
        t308,
        t309,
        t380,
        t378,
        t359,
        t334,
        t336,
        t326,
        t328,
        t320,
        t323,
        t261,
        t271,
        t273,
        t209,
        t255,
        t256,
        t226,
        t252,
        t248,
        t250,
        t249,
        t246,
        t232,
        t235,
        t180,
        t179,
        t176,
        t331,
    )


def loop_mx(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of mx; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(55 * BLOCK)
    for start in range(0, out.shape[1], BLOCK):
        m = min(BLOCK, out.shape[1] - start)
        for i in range(m):
            w[0 * BLOCK + i] = alpha[start + i]
            w[1 * BLOCK + i] = kappa[start + i]
            w[2 * BLOCK + i] = gamma[start + i]
            w[3 * BLOCK + i] = fz[start + i]
            w[4 * BLOCK + i] = speed[start + i]
            w[5 * BLOCK + i] = dpi[start + i]
        for i in range(m):
            g = mx(p, w[0 * BLOCK + i], w[1 * BLOCK + i], w[2 * BLOCK + i], w[3 * BLOCK + i], w[4 * BLOCK + i], w[5 * BLOCK + i])
            w[6 * BLOCK + i] = g[0]
            w[7 * BLOCK + i] = g[1]
            w[8 * BLOCK + i] = g[2]
            w[9 * BLOCK + i] = g[3]
            w[10 * BLOCK + i] = g[4]
            w[11 * BLOCK + i] = g[5]
            w[12 * BLOCK + i] = g[6]
            w[13 * BLOCK + i] = g[7]
            w[14 * BLOCK + i] = g[8]
            w[15 * BLOCK + i] = g[9]
            w[16 * BLOCK + i] = g[10]
            w[17 * BLOCK + i] = g[11]
            w[18 * BLOCK + i] = g[12]
            w[19 * BLOCK + i] = g[13]
            w[20 * BLOCK + i] = g[14]
            w[21 * BLOCK + i] = g[15]
            w[22 * BLOCK + i] = g[16]
            w[23 * BLOCK + i] = g[17]
            w[24 * BLOCK + i] = g[18]
            w[25 * BLOCK + i] = g[19]
            w[26 * BLOCK + i] = g[20]
            w[27 * BLOCK + i] = g[21]
            w[28 * BLOCK + i] = g[22]
            w[29 * BLOCK + i] = g[23]
            w[30 * BLOCK + i] = g[24]
            w[31 * BLOCK + i] = g[25]
            w[32 * BLOCK + i] = g[26]
            w[33 * BLOCK + i] = g[27]
            w[34 * BLOCK + i] = g[28]
            w[35 * BLOCK + i] = g[29]
            w[36 * BLOCK + i] = g[30]
            w[37 * BLOCK + i] = g[31]
            w[38 * BLOCK + i] = g[32]
            w[39 * BLOCK + i] = g[33]
            w[40 * BLOCK + i] = g[34]
            w[41 * BLOCK + i] = g[35]
            w[42 * BLOCK + i] = g[36]
            w[43 * BLOCK + i] = g[37]
            w[44 * BLOCK + i] = g[38]
            w[45 * BLOCK + i] = g[39]
            w[46 * BLOCK + i] = g[40]
            w[47 * BLOCK + i] = g[41]
            w[48 * BLOCK + i] = g[42]
            w[49 * BLOCK + i] = g[43]
            w[50 * BLOCK + i] = g[44]
            w[51 * BLOCK + i] = g[45]
            w[52 * BLOCK + i] = g[46]
            w[53 * BLOCK + i] = g[47]
            w[54 * BLOCK + i] = g[48]
        for k in range(49):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]


@jitable
def my(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of my."""
    t0 = p.FNOMIN * p.LFZO
    t1 = fz - t0
    t2 = t1 / t0
    t3 = gamma * p.LGAX
    t4 = p.PKX2 * t2
    t5 = p.PKX1 + t4
    t6 = fz * t5
    t7 = p.PKX3 * t2
    t8 = maximum(t7, -700.0)
    t9 = minimum(t8, 100.0)
    t10 = exp(t9)
    t11 = t6 * t10
    t12 = t11 * p.LKX
    t13 = p.PDX2 * t2
    t14 = p.PDX1 + t13
    t15 = p.PDX3 * t3
    t16 = t15 * t3
    t17 = 1.0 - t16
    t18 = t14 * t17
    t19 = t18 * p.LMUX
    t20 = p.PHX2 * t2
    t21 = p.PHX1 + t20
    t22 = t21 * p.LHX
    t23 = p.PVX2 * t2
    t24 = p.PVX1 + t23
    t25 = fz * t24
    t26 = t25 * p.LVX
    t27 = t26 * p.LMUX
    t28 = kappa + t22
    t29 = p.PCX1 * p.LCX
    t30 = t19 * fz
    t31 = p.PEX2 * t2
    t32 = p.PEX1 + t31
    t33 = p.PEX3 * t2
    t34 = t33 * t2
    t35 = t32 + t34
    t36 = t28 > 0.0
    t37 = t28 < 0.0
    t38 = select(t37, -1.0, 0.0)
    t39 = select(t36, 1.0, t38)
    t40 = p.PEX4 * t39
    t41 = 1.0 - t40
    t42 = t35 * t41
    t43 = t42 * p.LEX
    t44 = t29 * t30
    t45 = t44 == 0.0
    t46 = select(t45, 1.0, t44)
    t47 = t12 / t46
    t48 = select(t45, 0.0, t47)
    t49 = minimum(t43, 1.0)
    t50 = t48 * t28
    t51 = maximum(t50, -1e+150)
    t52 = minimum(t51, 1e+150)
    t53 = 1.0 - t49
    t54 = t53 * t52
    t55 = arctan(t52)
    t56 = t49 * t55
    t57 = t54 + t56
    t58 = arctan(t57)
    t59 = t29 * t58
    t60 = sin(t59)
    t61 = t30 * t60
    t62 = t61 + t27
    t63 = p.RBX2 * kappa
    t64 = t63 * t63
    t65 = 1.0 + t64
    t66 = sqrt(t65)
    t67 = 1.0 / t66
    t68 = p.RBX1 * t67
    t69 = t68 * p.LXAL
    t70 = p.REX2 * t2
    t71 = p.REX1 + t70
    t72 = minimum(t71, 1.0)
    t73 = alpha + p.RHX1
    t74 = t69 * t73
    t75 = maximum(t74, -1e+150)
    t76 = minimum(t75, 1e+150)
    t77 = 1.0 - t72
    t78 = t77 * t76
    t79 = arctan(t76)
    t80 = t72 * t79
    t81 = t78 + t80
    t82 = arctan(t81)
    t83 = p.RCX1 * t82
    t84 = cos(t83)
    t85 = t69 * p.RHX1
    t86 = maximum(t85, -1e+150)
    t87 = minimum(t86, 1e+150)
    t88 = t77 * t87
    t89 = arctan(t87)
    t90 = t72 * t89
    t91 = t88 + t90
    t92 = arctan(t91)
    t93 = p.RCX1 * t92
    t94 = cos(t93)
    t95 = t94 == 0.0
    t96 = select(t95, 1.0, t94)
    t97 = t84 / t96
    t98 = select(t95, 0.0, t97)
    t99 = t62 * t98
    t100 = speed / p.LONGVL
    t101 = t100 * t100
    t102 = p.QSY2 * t99
    t103 = t102 / p.FNOMIN
    t104 = p.QSY1 + t103
    t105 = absolute(t100)
    t106 = p.QSY3 * t105
    t107 = t104 + t106
    t108 = p.QSY4 * t101
    t109 = t108 * t101
    t110 = t107 + t109
    t111 = t12 * t22
    t112 = t27 + t111
    t113 = -p.UNLOADED_RADIUS
    t114 = t113 * fz
    t115 = t114 * t110
    t116 = p.QSY1 == 0.0
    t117 = p.QSY2 == 0.0
    t118 = t116 & t117
    t119 = speed > 0.0
    t120 = speed < 0.0
    t121 = select(t120, -1.0, 0.0)
    t122 = select(t119, 1.0, t121)
    t123 = sin(t93)
    t124 = t91 * t91
    t125 = 1.0 + t124
    t126 = t87 * t87
    t127 = 1.0 + t126
    t128 = t86 < 1e+150
    t129 = t85 > -1e+150
    t130 = sin(t83)
    t131 = t81 * t81
    t132 = 1.0 + t131
    t133 = t76 * t76
    t134 = 1.0 + t133
    t135 = t75 < 1e+150
    t136 = t74 > -1e+150
    t137 = t71 < 1.0
    t138 = t66 == 0.0
    t139 = cos(t59)
    t140 = t57 * t57
    t141 = 1.0 + t140
    t142 = t52 * t52
    t143 = 1.0 + t142
    t144 = t51 < 1e+150
    t145 = t50 > -1e+150
    t146 = t43 < 1.0
    t147 = t8 < 100.0
    t148 = t7 > -700.0
    t149 = select(t118, t122, 0.0)
    t150 = select(t118, 0.0, t122)
    t151 = t150 * p.LMY
    t152 = t150 * t115
    t153 = t151 * t110
    t154 = t151 * t114
    t155 = t153 * fz
    t156 = -t155
    t157 = t149 * t112
    t158 = t149 * p.UNLOADED_RADIUS
    t159 = t156 + t157
    t160 = t158 * t22
    t161 = t158 * t12
    t162 = t154 * t101
    t163 = t154 * t108
    t164 = t162 * t101
    t165 = t162 * p.QSY4
    t166 = t163 + t165
    t167 = t154 * t105
    t168 = t154 * p.QSY3
    t169 = t100 < 0.0
    t170 = -t168
    t171 = select(t169, t170, t168)
    t172 = t154 / p.FNOMIN
    t173 = t172 * t103
    t174 = -t173
    t175 = t172 * t99
    t176 = t172 * p.QSY2
    t177 = t166 * t100
    t178 = t171 + t177
    t179 = t178 + t177
    t180 = t179 / p.LONGVL
    t181 = t180 * t100
    t182 = -t181
    t183 = t176 * t98
    t184 = t176 * t62
    t185 = select(t95, 0.0, t184)
    t186 = t185 / t96
    t187 = t186 * t97
    t188 = -t187
    t189 = select(t95, 0.0, t188)
    t190 = t189 * t123
    t191 = -t190
    t192 = t191 * t92
    t193 = t191 * p.RCX1
    t194 = t193 / t125
    t195 = t194 * t89
    t196 = t194 * t72
    t197 = t196 / t127
    t198 = t194 * t87
    t199 = t194 * t77
    t200 = t197 + t199
    t201 = select(t128, t200, 0.0)
    t202 = select(t129, t201, 0.0)
    t203 = t202 * p.RHX1
    t204 = t202 * t69
    t205 = t186 * t130
    t206 = -t205
    t207 = t206 * t82
    t208 = t206 * p.RCX1
    t209 = t192 + t207
    t210 = t208 / t132
    t211 = t210 * t79
    t212 = t210 * t72
    t213 = t195 + t211
    t214 = t212 / t134
    t215 = t210 * t76
    t216 = t210 * t77
    t217 = t198 + t215
    t218 = t214 + t216
    t219 = -t217
    t220 = t213 + t219
    t221 = select(t135, t218, 0.0)
    t222 = select(t136, t221, 0.0)
    t223 = t222 * t73
    t224 = t222 * t69
    t225 = t203 + t223
    t226 = t204 + t224
    t227 = select(t137, t220, 0.0)
    t228 = t227 * t2
    t229 = t227 * p.REX2
    t230 = t225 * p.LXAL
    t231 = t225 * t68
    t232 = t230 * t67
    t233 = t230 * p.RBX1
    t234 = t233 / t66
    t235 = t234 * t67
    t236 = -t235
    t237 = 0.5 * t236
    t238 = t237 / t66
    t239 = select(t138, 0.0, t238)
    t240 = t239 * t63
    t241 = t240 + t240
    t242 = t241 * kappa
    t243 = t158 + t183
    t244 = t183 * t60
    t245 = t183 * t30
    t246 = t245 * t139
    t247 = t246 * t58
    t248 = t246 * t29
    t249 = t248 / t141
    t250 = t249 * t55
    t251 = t249 * t49
    t252 = t251 / t143
    t253 = t249 * t52
    t254 = t249 * t53
    t255 = t252 + t254
    t256 = -t253
    t257 = t250 + t256
    t258 = select(t144, t255, 0.0)
    t259 = select(t145, t258, 0.0)
    t260 = t259 * t28
    t261 = t259 * t48
    t262 = select(t146, t257, 0.0)
    t263 = select(t45, 0.0, t260)
    t264 = t263 / t46
    t265 = t264 * t47
    t266 = -t265
    t267 = t160 + t264
    t268 = select(t45, 0.0, t266)
    t269 = t268 * t30
    t270 = t268 * t29
    t271 = t247 + t269
    t272 = t244 + t270
    t273 = t262 * p.LEX
    t274 = t262 * t42
    t275 = t273 * t41
    t276 = t273 * t35
    t277 = -t276
    t278 = t277 * t39
    t279 = t275 * t2
    t280 = t275 * t33
    t281 = t229 + t280
    t282 = t279 * t2
    t283 = t279 * p.PEX3
    t284 = t281 + t283
    t285 = t275 * p.PEX2
    t286 = t284 + t285
    t287 = t272 * fz
    t288 = t271 * p.LCX
    t289 = t271 * p.PCX1
    t290 = t161 + t261
    t291 = t243 * p.LMUX
    t292 = t243 * t26
    t293 = t291 * p.LVX
    t294 = t291 * t25
    t295 = t293 * fz
    t296 = t295 * t2
    t297 = t295 * p.PVX2
    t298 = t286 + t297
    t299 = t290 * p.LHX
    t300 = t290 * t21
    t301 = t299 * t2
    t302 = t299 * p.PHX2
    t303 = t298 + t302
    t304 = t287 * p.LMUX
    t305 = t287 * t18
    t306 = t292 + t305
    t307 = t304 * t17
    t308 = t304 * t14
    t309 = -t308
    t310 = t309 * t3
    t311 = t309 * t15
    t312 = t310 * t3
    t313 = t310 * p.PDX3
    t314 = t311 + t313
    t315 = t307 * t2
    t316 = t307 * p.PDX2
    t317 = t303 + t316
    t318 = t267 * p.LKX
    t319 = t267 * t11
    t320 = t318 * t10
    t321 = t318 * t6
    t322 = t321 * t10
    t323 = select(t147, t322, 0.0)
    t324 = select(t148, t323, 0.0)
    t325 = t324 * t2
    t326 = t324 * p.PKX3
    t327 = t317 + t326
    t328 = t320 * fz
    t329 = t328 * t2
    t330 = t328 * p.PKX2
    t331 = t327 + t330
    t332 = t314 * gamma
    t333 = t331 / t0
    t334 = t333 * t2
    t335 = -t334
    t336 = -t333
    t337 = t335 + t336
    t338 = t337 * p.LFZO
    t339 = t337 * p.FNOMIN
    t340 = t174 + t338
    return (
        t340,
        t159,
        t182,
        t339,
        t289,
        t306,
        t274,
        t319,
        t300,
        t294,
        t231,
        t152,
        t332,
        t288,
        t307,
        t315,
        t312,
        t275,
        t279,
        t282,
        t278,
        t328,
        t329,
        t325,
        t299,
        t301,
        t295,
        t296,
        t232,
        t242,
        t209,
        t227,
        t228,
        t226,
        t154,
        t175,
        t167,
        t164,
    )


def loop_my(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of my; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(44 * BLOCK)
    for start in range(0, out.shape[1], BLOCK):
        m = min(BLOCK, out.shape[1] - start)
        for i in range(m):
            w[0 * BLOCK + i] = alpha[start + i]
            w[1 * BLOCK + i] = kappa[start + i]
            w[2 * BLOCK + i] = gamma[start + i]
            w[3 * BLOCK + i] = fz[start + i]
            w[4 * BLOCK + i] = speed[start + i]
            w[5 * BLOCK + i] = dpi[start + i]
        for i in range(m):
            g = my(p, w[0 * BLOCK + i], w[1 * BLOCK + i], w[2 * BLOCK + i], w[3 * BLOCK + i], w[4 * BLOCK + i], w[5 * BLOCK + i])
            w[6 * BLOCK + i] = g[0]
            w[7 * BLOCK + i] = g[1]
            w[8 * BLOCK + i] = g[2]
            w[9 * BLOCK + i] = g[3]
            w[10 * BLOCK + i] = g[4]
            w[11 * BLOCK + i] = g[5]
            w[12 * BLOCK + i] = g[6]
            w[13 * BLOCK + i] = g[7]
            w[14 * BLOCK + i] = g[8]
            w[15 * BLOCK + i] = g[9]
            w[16 * BLOCK + i] = g[10]
            w[17 * BLOCK + i] = g[11]
            w[18 * BLOCK + i] = g[12]
            w[19 * BLOCK + i] = g[13]
            w[20 * BLOCK + i] = g[14]
            w[21 * BLOCK + i] = g[15]
            w[22 * BLOCK + i] = g[16]
            w[23 * BLOCK + i] = g[17]
            w[24 * BLOCK + i] = g[18]
            w[25 * BLOCK + i] = g[19]
            w[26 * BLOCK + i] = g[20]
            w[27 * BLOCK + i] = g[21]
            w[28 * BLOCK + i] = g[22]
            w[29 * BLOCK + i] = g[23]
            w[30 * BLOCK + i] = g[24]
            w[31 * BLOCK + i] = g[25]
            w[32 * BLOCK + i] = g[26]
            w[33 * BLOCK + i] = g[27]
            w[34 * BLOCK + i] = g[28]
            w[35 * BLOCK + i] = g[29]
            w[36 * BLOCK + i] = g[30]
            w[37 * BLOCK + i] = g[31]
            w[38 * BLOCK + i] = g[32]
            w[39 * BLOCK + i] = g[33]
            w[40 * BLOCK + i] = g[34]
            w[41 * BLOCK + i] = g[35]
            w[42 * BLOCK + i] = g[36]
            w[43 * BLOCK + i] = g[37]
        for k in range(38):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]


@jitable
def mz(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of mz."""
    t0 = p.FNOMIN * p.LFZO
    t1 = fz - t0
    t2 = t1 / t0
    t3 = gamma * p.LGAX
    t4 = p.PKX2 * t2
    t5 = p.PKX1 + t4
    t6 = fz * t5
    t7 = p.PKX3 * t2
    t8 = maximum(t7, -700.0)
    t9 = minimum(t8, 100.0)
    t10 = exp(t9)
    t11 = t6 * t10
    t12 = t11 * p.LKX
    t13 = p.PDX2 * t2
    t14 = p.PDX1 + t13
    t15 = p.PDX3 * t3
    t16 = t15 * t3
    t17 = 1.0 - t16
    t18 = t14 * t17
    t19 = t18 * p.LMUX
    t20 = p.PHX2 * t2
    t21 = p.PHX1 + t20
    t22 = t21 * p.LHX
    t23 = p.PVX2 * t2
    t24 = p.PVX1 + t23
    t25 = fz * t24
    t26 = t25 * p.LVX
    t27 = t26 * p.LMUX
    t28 = kappa + t22
    t29 = p.PCX1 * p.LCX
    t30 = t19 * fz
    t31 = p.PEX2 * t2
    t32 = p.PEX1 + t31
    t33 = p.PEX3 * t2
    t34 = t33 * t2
    t35 = t32 + t34
    t36 = t28 > 0.0
    t37 = t28 < 0.0
    t38 = select(t37, -1.0, 0.0)
    t39 = select(t36, 1.0, t38)
    t40 = p.PEX4 * t39
    t41 = 1.0 - t40
    t42 = t35 * t41
    t43 = t42 * p.LEX
    t44 = t29 * t30
    t45 = t44 == 0.0
    t46 = select(t45, 1.0, t44)
    t47 = t12 / t46
    t48 = select(t45, 0.0, t47)
    t49 = minimum(t43, 1.0)
    t50 = t48 * t28
    t51 = maximum(t50, -1e+150)
    t52 = minimum(t51, 1e+150)
    t53 = 1.0 - t49
    t54 = t53 * t52
    t55 = arctan(t52)
    t56 = t49 * t55
    t57 = t54 + t56
    t58 = arctan(t57)
    t59 = t29 * t58
    t60 = sin(t59)
    t61 = t30 * t60
    t62 = t61 + t27
    t63 = gamma * p.LGAY
    t64 = p.PKY1 * t0
    t65 = p.PKY2 * t0
    t66 = t65 == 0.0
    t67 = select(t66, 1.0, t65)
    t68 = fz / t67
    t69 = select(t66, 0.0, t68)
    t70 = 2.0 * t69
    t71 = t69 * t69
    t72 = 1.0 + t71
    t73 = t70 / t72
    t74 = t64 * t73
    t75 = absolute(t63)
    t76 = p.PKY3 * t75
    t77 = 1.0 - t76
    t78 = t74 * t77
    t79 = t78 * p.LKY
    t80 = p.PDY2 * t2
    t81 = p.PDY1 + t80
    t82 = p.PDY3 * t63
    t83 = t82 * t63
    t84 = 1.0 - t83
    t85 = t81 * t84
    t86 = t85 * p.LMUY
    t87 = p.PHY2 * t2
    t88 = p.PHY1 + t87
    t89 = t88 * p.LHY
    t90 = p.PHY3 * t63
    t91 = t89 + t90
    t92 = p.PVY2 * t2
    t93 = p.PVY1 + t92
    t94 = t93 * p.LVY
    t95 = p.PVY4 * t2
    t96 = p.PVY3 + t95
    t97 = t96 * t63
    t98 = t94 + t97
    t99 = fz * t98
    t100 = t99 * p.LMUY
    t101 = alpha + t91
    t102 = p.PCY1 * p.LCY
    t103 = t86 * fz
    t104 = p.PEY2 * t2
    t105 = p.PEY1 + t104
    t106 = p.PEY4 * t63
    t107 = p.PEY3 + t106
    t108 = t101 > 0.0
    t109 = t101 < 0.0
    t110 = select(t109, -1.0, 0.0)
    t111 = select(t108, 1.0, t110)
    t112 = t107 * t111
    t113 = 1.0 - t112
    t114 = t105 * t113
    t115 = t114 * p.LEY
    t116 = t102 * t103
    t117 = t116 == 0.0
    t118 = select(t117, 1.0, t116)
    t119 = t79 / t118
    t120 = select(t117, 0.0, t119)
    t121 = minimum(t115, 1.0)
    t122 = t120 * t101
    t123 = maximum(t122, -1e+150)
    t124 = minimum(t123, 1e+150)
    t125 = 1.0 - t121
    t126 = t125 * t124
    t127 = arctan(t124)
    t128 = t121 * t127
    t129 = t126 + t128
    t130 = arctan(t129)
    t131 = t102 * t130
    t132 = sin(t131)
    t133 = t103 * t132
    t134 = t133 + t100
    t135 = t120 * t102
    t136 = p.RBX2 * kappa
    t137 = t136 * t136
    t138 = 1.0 + t137
    t139 = sqrt(t138)
    t140 = 1.0 / t139
    t141 = p.RBX1 * t140
    t142 = t141 * p.LXAL
    t143 = p.REX2 * t2
    t144 = p.REX1 + t143
    t145 = minimum(t144, 1.0)
    t146 = alpha + p.RHX1
    t147 = t142 * t146
    t148 = maximum(t147, -1e+150)
    t149 = minimum(t148, 1e+150)
    t150 = 1.0 - t145
    t151 = t150 * t149
    t152 = arctan(t149)
    t153 = t145 * t152
    t154 = t151 + t153
    t155 = arctan(t154)
    t156 = p.RCX1 * t155
    t157 = cos(t156)
    t158 = t142 * p.RHX1
    t159 = maximum(t158, -1e+150)
    t160 = minimum(t159, 1e+150)
    t161 = t150 * t160
    t162 = arctan(t160)
    t163 = t145 * t162
    t164 = t161 + t163
    t165 = arctan(t164)
    t166 = p.RCX1 * t165
    t167 = cos(t166)
    t168 = t167 == 0.0
    t169 = select(t168, 1.0, t167)
    t170 = t157 / t169
    t171 = select(t168, 0.0, t170)
    t172 = t62 * t171
    t173 = alpha - p.RBY3
    t174 = p.RBY2 * t173
    t175 = t174 * t174
    t176 = 1.0 + t175
    t177 = sqrt(t176)
    t178 = 1.0 / t177
    t179 = p.RBY1 * t178
    t180 = t179 * p.LYKA
    t181 = p.REY2 * t2
    t182 = p.REY1 + t181
    t183 = minimum(t182, 1.0)
    t184 = p.RHY2 * t2
    t185 = p.RHY1 + t184
    t186 = p.RVY2 * t2
    t187 = p.RVY1 + t186
    t188 = p.RVY3 * gamma
    t189 = t187 + t188
    t190 = t103 * t189
    t191 = p.RVY4 * alpha
    t192 = t191 * t191
    t193 = 1.0 + t192
    t194 = sqrt(t193)
    t195 = 1.0 / t194
    t196 = t190 * t195
    t197 = p.RVY6 * kappa
    t198 = arctan(t197)
    t199 = p.RVY5 * t198
    t200 = sin(t199)
    t201 = t196 * t200
    t202 = t201 * p.LVYKA
    t203 = kappa + t185
    t204 = t180 * t203
    t205 = maximum(t204, -1e+150)
    t206 = minimum(t205, 1e+150)
    t207 = 1.0 - t183
    t208 = t207 * t206
    t209 = arctan(t206)
    t210 = t183 * t209
    t211 = t208 + t210
    t212 = arctan(t211)
    t213 = p.RCY1 * t212
    t214 = cos(t213)
    t215 = t180 * t185
    t216 = maximum(t215, -1e+150)
    t217 = minimum(t216, 1e+150)
    t218 = t207 * t217
    t219 = arctan(t217)
    t220 = t183 * t219
    t221 = t218 + t220
    t222 = arctan(t221)
    t223 = p.RCY1 * t222
    t224 = cos(t223)
    t225 = t224 == 0.0
    t226 = select(t225, 1.0, t224)
    t227 = t214 / t226
    t228 = select(t225, 0.0, t227)
    t229 = t134 * t228
    t230 = t229 + t202
    t231 = t79 == 0.0
    t232 = select(t231, 1.0, t79)
    t233 = t12 / t232
    t234 = select(t231, 0.0, t233)
    t235 = gamma * p.LGAZ
    t236 = alpha + p.QHZ1
    t237 = p.QHZ2 * t2
    t238 = t236 + t237
    t239 = p.QHZ4 * t2
    t240 = p.QHZ3 + t239
    t241 = t240 * t235
    t242 = t238 + t241
    t243 = p.QBZ2 * t2
    t244 = p.QBZ1 + t243
    t245 = p.QBZ3 * t2
    t246 = t245 * t2
    t247 = t244 + t246
    t248 = p.QBZ4 * t235
    t249 = 1.0 + t248
    t250 = absolute(t235)
    t251 = p.QBZ5 * t250
    t252 = t249 + t251
    t253 = t247 * t252
    t254 = t253 * p.LKY
    t255 = t254 / p.LMUY
    t256 = p.QDZ2 * t2
    t257 = p.QDZ1 + t256
    t258 = fz * t257
    t259 = p.QDZ3 * t235
    t260 = 1.0 + t259
    t261 = p.QDZ4 * t235
    t262 = t261 * t235
    t263 = t260 + t262
    t264 = t258 * t263
    t265 = p.UNLOADED_RADIUS / p.FNOMIN
    t266 = t264 * t265
    t267 = t266 * p.LTR
    t268 = p.QEZ2 * t2
    t269 = p.QEZ1 + t268
    t270 = p.QEZ3 * t2
    t271 = t270 * t2
    t272 = t269 + t271
    t273 = p.QEZ5 * t235
    t274 = p.QEZ4 + t273
    t275 = t274 * 0.6366197723675814
    t276 = t255 * p.QCZ1
    t277 = t276 * t242
    t278 = arctan(t277)
    t279 = t275 * t278
    t280 = 1.0 + t279
    t281 = t272 * t280
    t282 = sin(t242)
    t283 = cos(t242)
    t284 = t283 == 0.0
    t285 = select(t284, 1.0, t283)
    t286 = t282 / t285
    t287 = select(t284, 0.0, t286)
    t288 = maximum(t234, -1e+150)
    t289 = minimum(t288, 1e+150)
    t290 = t289 * kappa
    t291 = t287 * t287
    t292 = t290 * t290
    t293 = minimum(t292, 9.999999999999999e+299)
    t294 = t291 + t293
    t295 = sqrt(t294)
    t296 = arctan(t295)
    t297 = t242 > 0.0
    t298 = t242 < 0.0
    t299 = select(t298, -1.0, 0.0)
    t300 = select(t297, 1.0, t299)
    t301 = t296 * t300
    t302 = minimum(t281, 1.0)
    t303 = t255 * t301
    t304 = maximum(t303, -1e+150)
    t305 = minimum(t304, 1e+150)
    t306 = 1.0 - t302
    t307 = t306 * t305
    t308 = arctan(t305)
    t309 = t302 * t308
    t310 = t307 + t309
    t311 = arctan(t310)
    t312 = p.QCZ1 * t311
    t313 = cos(t312)
    t314 = t267 * t313
    t315 = cos(alpha)
    t316 = t314 * t315
    t317 = t100 / t232
    t318 = select(t231, 0.0, t317)
    t319 = t101 + t318
    t320 = p.QBZ9 * p.LKY
    t321 = t320 / p.LMUY
    t322 = p.QBZ10 * t135
    t323 = t321 + t322
    t324 = p.QDZ7 * t2
    t325 = p.QDZ6 + t324
    t326 = t325 * p.LRES
    t327 = p.QDZ9 * t2
    t328 = p.QDZ8 + t327
    t329 = t328 * t235
    t330 = t326 + t329
    t331 = fz * t330
    t332 = t331 * p.UNLOADED_RADIUS
    t333 = t332 * p.LMUY
    t334 = sin(t319)
    t335 = cos(t319)
    t336 = t335 == 0.0
    t337 = select(t336, 1.0, t335)
    t338 = t334 / t337
    t339 = select(t336, 0.0, t338)
    t340 = t339 * t339
    t341 = t340 + t293
    t342 = sqrt(t341)
    t343 = arctan(t342)
    t344 = t319 > 0.0
    t345 = t319 < 0.0
    t346 = select(t345, -1.0, 0.0)
    t347 = select(t344, 1.0, t346)
    t348 = t343 * t347
    t349 = t323 * t348
    t350 = t349 * t349
    t351 = 1.0 + t350
    t352 = sqrt(t351)
    t353 = 1.0 / t352
    t354 = p.SSZ2 * t230
    t355 = t354 / p.FNOMIN
    t356 = p.SSZ1 + t355
    t357 = p.SSZ4 * t2
    t358 = p.SSZ3 + t357
    t359 = t358 * gamma
    t360 = t356 + t359
    t361 = t360 * p.UNLOADED_RADIUS
    t362 = t361 * p.LS
    t363 = -t316
    t364 = t230 - t202
    t365 = sin(t166)
    t366 = t164 * t164
    t367 = 1.0 + t366
    t368 = t160 * t160
    t369 = 1.0 + t368
    t370 = t159 < 1e+150
    t371 = t158 > -1e+150
    t372 = sin(t156)
    t373 = t154 * t154
    t374 = 1.0 + t373
    t375 = t149 * t149
    t376 = 1.0 + t375
    t377 = t148 < 1e+150
    t378 = t147 > -1e+150
    t379 = t144 < 1.0
    t380 = t139 == 0.0
    t381 = cos(t59)
    t382 = t57 * t57
    t383 = 1.0 + t382
    t384 = t52 * t52
    t385 = 1.0 + t384
    t386 = t51 < 1e+150
    t387 = t50 > -1e+150
    t388 = t43 < 1.0
    t389 = t8 < 100.0
    t390 = t7 > -700.0
    t391 = sin(t223)
    t392 = t221 * t221
    t393 = 1.0 + t392
    t394 = t217 * t217
    t395 = 1.0 + t394
    t396 = t216 < 1e+150
    t397 = t215 > -1e+150
    t398 = sin(t213)
    t399 = t211 * t211
    t400 = 1.0 + t399
    t401 = t206 * t206
    t402 = 1.0 + t401
    t403 = t205 < 1e+150
    t404 = t204 > -1e+150
    t405 = cos(t199)
    t406 = t197 * t197
    t407 = 1.0 + t406
    t408 = t194 == 0.0
    t409 = t182 < 1.0
    t410 = t177 == 0.0
    t411 = cos(t131)
    t412 = t129 * t129
    t413 = 1.0 + t412
    t414 = t124 * t124
    t415 = 1.0 + t414
    t416 = t123 < 1e+150
    t417 = t122 > -1e+150
    t418 = t115 < 1.0
    t419 = t63 < 0.0
    t420 = -t363
    t421 = -t364
    t422 = t172 * p.LS
    t423 = t172 * t361
    t424 = t422 * p.UNLOADED_RADIUS
    t425 = t422 * t360
    t426 = t424 * gamma
    t427 = t426 * t2
    t428 = t426 * p.SSZ4
    t429 = t424 / p.FNOMIN
    t430 = t429 * t355
    t431 = -t430
    t432 = t429 * t230
    t433 = t429 * p.SSZ2
    t434 = t363 + t433
    t435 = t315 * t353
    t436 = t315 * t333
    t437 = t436 / t352
    t438 = t437 * t353
    t439 = -t438
    t440 = t352 == 0.0
    t441 = 0.5 * t439
    t442 = t441 / t352
    t443 = select(t440, 0.0, t442)
    t444 = t443 * t349
    t445 = t444 + t444
    t446 = t445 * t348
    t447 = t445 * t323
    t448 = t447 * t347
    t449 = t342 * t342
    t450 = 1.0 + t449
    t451 = t448 / t450
    t452 = t342 == 0.0
    t453 = 0.5 * t451
    t454 = t453 / t342
    t455 = select(t452, 0.0, t454)
    t456 = t455 * t339
    t457 = t456 + t456
    t458 = select(t336, 0.0, t457)
    t459 = t458 / t337
    t460 = t459 * t338
    t461 = -t460
    t462 = select(t336, 0.0, t461)
    t463 = t462 * t334
    t464 = -t463
    t465 = t459 * t335
    t466 = t464 + t465
    t467 = t435 * p.LMUY
    t468 = t435 * t332
    t469 = t467 * p.UNLOADED_RADIUS
    t470 = t467 * t331
    t471 = t425 + t470
    t472 = t469 * fz
    t473 = t472 * t235
    t474 = t472 * t328
    t475 = t473 * t2
    t476 = t473 * p.QDZ9
    t477 = t428 + t476
    t478 = t472 * p.LRES
    t479 = t472 * t325
    t480 = t478 * t2
    t481 = t478 * p.QDZ7
    t482 = t477 + t481
    t483 = t446 * t135
    t484 = t446 * p.QBZ10
    t485 = t446 / p.LMUY
    t486 = t485 * t321
    t487 = -t486
    t488 = t468 + t487
    t489 = t485 * p.LKY
    t490 = t485 * p.QBZ9
    t491 = select(t231, 0.0, t466)
    t492 = t491 / t232
    t493 = t492 * t317
    t494 = -t493
    t495 = t421 * t315
    t496 = t495 * t313
    t497 = t495 * t267
    t498 = sin(t312)
    t499 = t497 * t498
    t500 = -t499
    t501 = t500 * t311
    t502 = t500 * p.QCZ1
    t503 = t310 * t310
    t504 = 1.0 + t503
    t505 = t502 / t504
    t506 = t505 * t308
    t507 = t505 * t302
    t508 = t305 * t305
    t509 = 1.0 + t508
    t510 = t507 / t509
    t511 = t505 * t305
    t512 = t505 * t306
    t513 = t510 + t512
    t514 = -t511
    t515 = t506 + t514
    t516 = t304 < 1e+150
    t517 = select(t516, t513, 0.0)
    t518 = t303 > -1e+150
    t519 = select(t518, t517, 0.0)
    t520 = t519 * t301
    t521 = t519 * t255
    t522 = t281 < 1.0
    t523 = select(t522, t515, 0.0)
    t524 = t521 * t300
    t525 = t295 * t295
    t526 = 1.0 + t525
    t527 = t524 / t526
    t528 = t295 == 0.0
    t529 = 0.5 * t527
    t530 = t529 / t295
    t531 = select(t528, 0.0, t530)
    t532 = t455 + t531
    t533 = t292 < 9.999999999999999e+299
    t534 = select(t533, t532, 0.0)
    t535 = t534 * t290
    t536 = t535 + t535
    t537 = t531 * t287
    t538 = t537 + t537
    t539 = t536 * kappa
    t540 = t288 < 1e+150
    t541 = select(t540, t539, 0.0)
    t542 = t234 > -1e+150
    t543 = select(t542, t541, 0.0)
    t544 = select(t284, 0.0, t538)
    t545 = t544 / t285
    t546 = t545 * t286
    t547 = -t546
    t548 = select(t284, 0.0, t547)
    t549 = t548 * t282
    t550 = -t549
    t551 = t545 * t283
    t552 = t550 + t551
    t553 = t523 * t280
    t554 = t523 * t272
    t555 = t554 * t278
    t556 = t554 * t275
    t557 = t277 * t277
    t558 = 1.0 + t557
    t559 = t556 / t558
    t560 = t559 * t242
    t561 = t559 * t276
    t562 = t552 + t561
    t563 = t560 * p.QCZ1
    t564 = t560 * t255
    t565 = t520 + t563
    t566 = t501 + t564
    t567 = t555 * 0.6366197723675814
    t568 = t567 * t235
    t569 = t567 * p.QEZ5
    t570 = t474 + t569
    t571 = t553 * t2
    t572 = t553 * t270
    t573 = t482 + t572
    t574 = t571 * t2
    t575 = t571 * p.QEZ3
    t576 = t573 + t575
    t577 = t553 * p.QEZ2
    t578 = t576 + t577
    t579 = t496 * p.LTR
    t580 = t496 * t266
    t581 = t579 * t265
    t582 = t579 * t264
    t583 = t582 / p.FNOMIN
    t584 = t583 * t265
    t585 = -t584
    t586 = t471 + t583
    t587 = t431 + t585
    t588 = t581 * t263
    t589 = t581 * t258
    t590 = t589 * t235
    t591 = t589 * t261
    t592 = t570 + t591
    t593 = t590 * t235
    t594 = t590 * p.QDZ4
    t595 = t592 + t594
    t596 = t589 * p.QDZ3
    t597 = t595 + t596
    t598 = t588 * fz
    t599 = t598 * t2
    t600 = t598 * p.QDZ2
    t601 = t578 + t600
    t602 = t565 / p.LMUY
    t603 = t602 * t255
    t604 = -t603
    t605 = t488 + t604
    t606 = t602 * p.LKY
    t607 = t602 * t253
    t608 = t490 + t607
    t609 = t606 * t252
    t610 = t606 * t247
    t611 = t610 * t250
    t612 = t610 * p.QBZ5
    t613 = t235 < 0.0
    t614 = -t612
    t615 = select(t613, t614, t612)
    t616 = t597 + t615
    t617 = t610 * t235
    t618 = t610 * p.QBZ4
    t619 = t616 + t618
    t620 = t609 * t2
    t621 = t609 * t245
    t622 = t601 + t621
    t623 = t620 * t2
    t624 = t620 * p.QBZ3
    t625 = t622 + t624
    t626 = t609 * p.QBZ2
    t627 = t625 + t626
    t628 = t562 * t235
    t629 = t562 * t240
    t630 = t619 + t629
    t631 = t628 * t2
    t632 = t628 * p.QHZ4
    t633 = t627 + t632
    t634 = t562 * t2
    t635 = t562 * p.QHZ2
    t636 = t633 + t635
    t637 = t630 * gamma
    t638 = select(t231, 0.0, t543)
    t639 = t638 / t232
    t640 = t639 * t233
    t641 = -t640
    t642 = t494 + t641
    t643 = select(t231, 0.0, t642)
    t644 = t420 + t434
    t645 = t434 * t228
    t646 = t434 * t134
    t647 = select(t225, 0.0, t646)
    t648 = t647 / t226
    t649 = t648 * t227
    t650 = -t649
    t651 = select(t225, 0.0, t650)
    t652 = t651 * t391
    t653 = -t652
    t654 = t653 * t222
    t655 = t653 * p.RCY1
    t656 = t655 / t393
    t657 = t656 * t219
    t658 = t656 * t183
    t659 = t658 / t395
    t660 = t656 * t217
    t661 = t656 * t207
    t662 = t659 + t661
    t663 = select(t396, t662, 0.0)
    t664 = select(t397, t663, 0.0)
    t665 = t664 * t185
    t666 = t664 * t180
    t667 = t648 * t398
    t668 = -t667
    t669 = t668 * t212
    t670 = t668 * p.RCY1
    t671 = t654 + t669
    t672 = t670 / t400
    t673 = t672 * t209
    t674 = t672 * t183
    t675 = t657 + t673
    t676 = t674 / t402
    t677 = t672 * t206
    t678 = t672 * t207
    t679 = t660 + t677
    t680 = t676 + t678
    t681 = -t679
    t682 = t675 + t681
    t683 = select(t403, t680, 0.0)
    t684 = select(t404, t683, 0.0)
    t685 = t684 * t203
    t686 = t684 * t180
    t687 = t665 + t685
    t688 = t666 + t686
    t689 = t644 * p.LVYKA
    t690 = t644 * t201
    t691 = t689 * t200
    t692 = t689 * t196
    t693 = t692 * t405
    t694 = t693 * t198
    t695 = t693 * p.RVY5
    t696 = t695 / t407
    t697 = t696 * kappa
    t698 = t691 * t195
    t699 = t691 * t190
    t700 = t699 / t194
    t701 = t700 * t195
    t702 = -t701
    t703 = 0.5 * t702
    t704 = t703 / t194
    t705 = select(t408, 0.0, t704)
    t706 = t705 * t191
    t707 = t706 + t706
    t708 = t707 * alpha
    t709 = t698 * t189
    t710 = t698 * t103
    t711 = t710 * gamma
    t712 = t710 * t2
    t713 = t710 * p.RVY2
    t714 = t636 + t713
    t715 = t688 * t2
    t716 = t688 * p.RHY2
    t717 = t714 + t716
    t718 = select(t409, t682, 0.0)
    t719 = t718 * t2
    t720 = t718 * p.REY2
    t721 = t717 + t720
    t722 = t687 * p.LYKA
    t723 = t687 * t179
    t724 = t722 * t178
    t725 = t722 * p.RBY1
    t726 = t725 / t177
    t727 = t726 * t178
    t728 = -t727
    t729 = 0.5 * t728
    t730 = t729 / t177
    t731 = select(t410, 0.0, t730)
    t732 = t731 * t174
    t733 = t732 + t732
    t734 = t733 * t173
    t735 = t733 * p.RBY2
    t736 = -t735
    t737 = t362 * t171
    t738 = t362 * t62
    t739 = select(t168, 0.0, t738)
    t740 = t739 / t169
    t741 = t740 * t170
    t742 = -t741
    t743 = select(t168, 0.0, t742)
    t744 = t743 * t365
    t745 = -t744
    t746 = t745 * t165
    t747 = t745 * p.RCX1
    t748 = t747 / t367
    t749 = t748 * t162
    t750 = t748 * t145
    t751 = t750 / t369
    t752 = t748 * t160
    t753 = t748 * t150
    t754 = t751 + t753
    t755 = select(t370, t754, 0.0)
    t756 = select(t371, t755, 0.0)
    t757 = t756 * p.RHX1
    t758 = t756 * t142
    t759 = t740 * t372
    t760 = -t759
    t761 = t760 * t155
    t762 = t760 * p.RCX1
    t763 = t746 + t761
    t764 = t762 / t374
    t765 = t764 * t152
    t766 = t764 * t145
    t767 = t749 + t765
    t768 = t766 / t376
    t769 = t764 * t149
    t770 = t764 * t150
    t771 = t752 + t769
    t772 = t768 + t770
    t773 = -t771
    t774 = t767 + t773
    t775 = select(t377, t772, 0.0)
    t776 = select(t378, t775, 0.0)
    t777 = t776 * t146
    t778 = t776 * t142
    t779 = t757 + t777
    t780 = t758 + t778
    t781 = select(t379, t774, 0.0)
    t782 = t781 * t2
    t783 = t781 * p.REX2
    t784 = t721 + t783
    t785 = t779 * p.LXAL
    t786 = t779 * t141
    t787 = t785 * t140
    t788 = t785 * p.RBX1
    t789 = t788 / t139
    t790 = t789 * t140
    t791 = -t790
    t792 = 0.5 * t791
    t793 = t792 / t139
    t794 = select(t380, 0.0, t793)
    t795 = t794 * t136
    t796 = t795 + t795
    t797 = t796 * kappa
    t798 = t484 * t102
    t799 = t484 * t120
    t800 = t492 + t645
    t801 = t645 * t132
    t802 = t645 * t103
    t803 = t709 + t801
    t804 = t802 * t411
    t805 = t804 * t130
    t806 = t804 * t102
    t807 = t799 + t805
    t808 = t806 / t413
    t809 = t808 * t127
    t810 = t808 * t121
    t811 = t810 / t415
    t812 = t808 * t124
    t813 = t808 * t125
    t814 = t811 + t813
    t815 = -t812
    t816 = t809 + t815
    t817 = select(t416, t814, 0.0)
    t818 = select(t417, t817, 0.0)
    t819 = t818 * t101
    t820 = t818 * t120
    t821 = t798 + t819
    t822 = t466 + t820
    t823 = select(t418, t816, 0.0)
    t824 = select(t117, 0.0, t821)
    t825 = t824 / t118
    t826 = t825 * t119
    t827 = -t826
    t828 = t643 + t825
    t829 = select(t117, 0.0, t827)
    t830 = t829 * t103
    t831 = t829 * t102
    t832 = t807 + t830
    t833 = t803 + t831
    t834 = t823 * p.LEY
    t835 = t823 * t114
    t836 = t834 * t113
    t837 = t834 * t105
    t838 = -t837
    t839 = t838 * t111
    t840 = t839 * t63
    t841 = t839 * p.PEY4
    t842 = t836 * t2
    t843 = t836 * p.PEY2
    t844 = t784 + t843
    t845 = t833 * fz
    t846 = t832 * p.LCY
    t847 = t832 * p.PCY1
    t848 = t800 * p.LMUY
    t849 = t800 * t99
    t850 = t605 + t849
    t851 = t848 * fz
    t852 = t851 * t63
    t853 = t851 * t96
    t854 = t841 + t853
    t855 = t852 * t2
    t856 = t852 * p.PVY4
    t857 = t844 + t856
    t858 = t851 * p.LVY
    t859 = t851 * t93
    t860 = t858 * t2
    t861 = t858 * p.PVY2
    t862 = t857 + t861
    t863 = t822 * t63
    t864 = t822 * p.PHY3
    t865 = t854 + t864
    t866 = t822 * p.LHY
    t867 = t822 * t88
    t868 = t866 * t2
    t869 = t866 * p.PHY2
    t870 = t862 + t869
    t871 = t845 * p.LMUY
    t872 = t845 * t85
    t873 = t850 + t872
    t874 = t871 * t84
    t875 = t871 * t81
    t876 = -t875
    t877 = t876 * t63
    t878 = t876 * t82
    t879 = t865 + t878
    t880 = t877 * t63
    t881 = t877 * p.PDY3
    t882 = t879 + t881
    t883 = t874 * t2
    t884 = t874 * p.PDY2
    t885 = t870 + t884
    t886 = t828 * p.LKY
    t887 = t828 * t78
    t888 = t608 + t887
    t889 = t886 * t77
    t890 = t886 * t74
    t891 = -t890
    t892 = t891 * t75
    t893 = t891 * p.PKY3
    t894 = -t893
    t895 = select(t419, t894, t893)
    t896 = t882 + t895
    t897 = t889 * t73
    t898 = t889 * t64
    t899 = t898 / t72
    t900 = t899 * t73
    t901 = -t900
    t902 = t901 * t69
    t903 = t902 + t902
    t904 = t899 * 2.0
    t905 = t903 + t904
    t906 = select(t66, 0.0, t905)
    t907 = t906 / t67
    t908 = t907 * t68
    t909 = -t908
    t910 = select(t66, 0.0, t909)
    t911 = t910 * t0
    t912 = t910 * p.PKY2
    t913 = t897 * t0
    t914 = t897 * p.PKY1
    t915 = t912 + t914
    t916 = t896 * gamma
    t917 = t737 * t60
    t918 = t737 * t30
    t919 = t918 * t381
    t920 = t919 * t58
    t921 = t919 * t29
    t922 = t921 / t383
    t923 = t922 * t55
    t924 = t922 * t49
    t925 = t924 / t385
    t926 = t922 * t52
    t927 = t922 * t53
    t928 = t925 + t927
    t929 = -t926
    t930 = t923 + t929
    t931 = select(t386, t928, 0.0)
    t932 = select(t387, t931, 0.0)
    t933 = t932 * t28
    t934 = t932 * t48
    t935 = select(t388, t930, 0.0)
    t936 = select(t45, 0.0, t933)
    t937 = t936 / t46
    t938 = t937 * t47
    t939 = -t938
    t940 = t639 + t937
    t941 = select(t45, 0.0, t939)
    t942 = t941 * t30
    t943 = t941 * t29
    t944 = t920 + t942
    t945 = t917 + t943
    t946 = t935 * p.LEX
    t947 = t935 * t42
    t948 = t946 * t41
    t949 = t946 * t35
    t950 = -t949
    t951 = t950 * t39
    t952 = t948 * t2
    t953 = t948 * t33
    t954 = t885 + t953
    t955 = t952 * t2
    t956 = t952 * p.PEX3
    t957 = t954 + t956
    t958 = t948 * p.PEX2
    t959 = t957 + t958
    t960 = t945 * fz
    t961 = t944 * p.LCX
    t962 = t944 * p.PCX1
    t963 = t737 * p.LMUX
    t964 = t737 * t26
    t965 = t963 * p.LVX
    t966 = t963 * t25
    t967 = t965 * fz
    t968 = t967 * t2
    t969 = t967 * p.PVX2
    t970 = t959 + t969
    t971 = t934 * p.LHX
    t972 = t934 * t21
    t973 = t971 * t2
    t974 = t971 * p.PHX2
    t975 = t970 + t974
    t976 = t960 * p.LMUX
    t977 = t960 * t18
    t978 = t964 + t977
    t979 = t976 * t17
    t980 = t976 * t14
    t981 = -t980
    t982 = t981 * t3
    t983 = t981 * t15
    t984 = t982 * t3
    t985 = t982 * p.PDX3
    t986 = t983 + t985
    t987 = t979 * t2
    t988 = t979 * p.PDX2
    t989 = t975 + t988
    t990 = t940 * p.LKX
    t991 = t940 * t11
    t992 = t990 * t10
    t993 = t990 * t6
    t994 = t993 * t10
    t995 = select(t389, t994, 0.0)
    t996 = select(t390, t995, 0.0)
    t997 = t996 * t2
    t998 = t996 * p.PKX3
    t999 = t989 + t998
    t1000 = t992 * fz
    t1001 = t1000 * t2
    t1002 = t1000 * p.PKX2
    t1003 = t999 + t1002
    t1004 = t986 * gamma
    t1005 = t1003 / t0
    t1006 = t1005 * t2
    t1007 = -t1006
    t1008 = t915 + t1007
    t1009 = -t1005
    t1010 = t1008 + t1009
    t1011 = t1010 * p.LFZO
    t1012 = t1010 * p.FNOMIN
    t1013 = t587 + t1011
    return (
        t1013,
        t586,
        t1012,
        t962,
        t978,
        t947,
        t991,
        t972,
        t966,
        t847,
        t873,
        t835,
        t888,
        t867,
        t859,
        t580,
        t479,
        t786,
        t723,
        t690,
        t423,
        t1004,
        t916,
        t637,
        t961,
        t979,
        t987,
        t984,
        t948,
        t952,
        t955,
        t951,
        t1000,
        t1001,
        t997,
        t971,
        t973,
        t967,
        t968,
        t846,
        t874,
        t883,
        t880,
        t836,
        t842,
        t839,
        t840,
        t913,
        t911,
        t892,
        t866,
        t868,
        t858,
        t860,
        t852,
        t855,
        t609,
        t620,
        t623,
        t617,
        t611,
        t489,
        t483,
        t566,
        t598,
        t599,
        t590,
        t593,
        t478,
        t480,
        t473,
        t475,
        t553,
        t571,
        t574,
        t567,
        t568,
        t562,
        t634,
        t628,
        t631,
        t787,
        t797,
        t763,
        t781,
        t782,
        t780,
        t724,
        t734,
        t736,
        t671,
        t718,
        t719,
        t688,
        t715,
        t710,
        t712,
        t711,
        t708,
        t694,
        t697,
        t424,
        t432,
        t426,
        t427,
        t863,
    )


def loop_mz(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of mz; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(112 * BLOCK)
    for start in range(0, out.shape[1], BLOCK):
        m = min(BLOCK, out.shape[1] - start)
        for i in range(m):
            w[0 * BLOCK + i] = alpha[start + i]
            w[1 * BLOCK + i] = kappa[start + i]
            w[2 * BLOCK + i] = gamma[start + i]
            w[3 * BLOCK + i] = fz[start + i]
            w[4 * BLOCK + i] = speed[start + i]
            w[5 * BLOCK + i] = dpi[start + i]
        for i in range(m):
            g = mz(p, w[0 * BLOCK + i], w[1 * BLOCK + i], w[2 * BLOCK + i], w[3 * BLOCK + i], w[4 * BLOCK + i], w[5 * BLOCK + i])
            w[6 * BLOCK + i] = g[0]
            w[7 * BLOCK + i] = g[1]
            w[8 * BLOCK + i] = g[2]
            w[9 * BLOCK + i] = g[3]
            w[10 * BLOCK + i] = g[4]
            w[11 * BLOCK + i] = g[5]
            w[12 * BLOCK + i] = g[6]
            w[13 * BLOCK + i] = g[7]
            w[14 * BLOCK + i] = g[8]
            w[15 * BLOCK + i] = g[9]
            w[16 * BLOCK + i] = g[10]
            w[17 * BLOCK + i] = g[11]
            w[18 * BLOCK + i] = g[12]
            w[19 * BLOCK + i] = g[13]
            w[20 * BLOCK + i] = g[14]
            w[21 * BLOCK + i] = g[15]
            w[22 * BLOCK + i] = g[16]
            w[23 * BLOCK + i] = g[17]
            w[24 * BLOCK + i] = g[18]
            w[25 * BLOCK + i] = g[19]
            w[26 * BLOCK + i] = g[20]
            w[27 * BLOCK + i] = g[21]
            w[28 * BLOCK + i] = g[22]
            w[29 * BLOCK + i] = g[23]
            w[30 * BLOCK + i] = g[24]
            w[31 * BLOCK + i] = g[25]
            w[32 * BLOCK + i] = g[26]
            w[33 * BLOCK + i] = g[27]
            w[34 * BLOCK + i] = g[28]
            w[35 * BLOCK + i] = g[29]
            w[36 * BLOCK + i] = g[30]
            w[37 * BLOCK + i] = g[31]
            w[38 * BLOCK + i] = g[32]
            w[39 * BLOCK + i] = g[33]
            w[40 * BLOCK + i] = g[34]
            w[41 * BLOCK + i] = g[35]
            w[42 * BLOCK + i] = g[36]
            w[43 * BLOCK + i] = g[37]
            w[44 * BLOCK + i] = g[38]
            w[45 * BLOCK + i] = g[39]
            w[46 * BLOCK + i] = g[40]
            w[47 * BLOCK + i] = g[41]
            w[48 * BLOCK + i] = g[42]
            w[49 * BLOCK + i] = g[43]
            w[50 * BLOCK + i] = g[44]
            w[51 * BLOCK + i] = g[45]
            w[52 * BLOCK + i] = g[46]
            w[53 * BLOCK + i] = g[47]
            w[54 * BLOCK + i] = g[48]
            w[55 * BLOCK + i] = g[49]
            w[56 * BLOCK + i] = g[50]
            w[57 * BLOCK + i] = g[51]
            w[58 * BLOCK + i] = g[52]
            w[59 * BLOCK + i] = g[53]
            w[60 * BLOCK + i] = g[54]
            w[61 * BLOCK + i] = g[55]
            w[62 * BLOCK + i] = g[56]
            w[63 * BLOCK + i] = g[57]
            w[64 * BLOCK + i] = g[58]
            w[65 * BLOCK + i] = g[59]
            w[66 * BLOCK + i] = g[60]
            w[67 * BLOCK + i] = g[61]
            w[68 * BLOCK + i] = g[62]
            w[69 * BLOCK + i] = g[63]
            w[70 * BLOCK + i] = g[64]
            w[71 * BLOCK + i] = g[65]
            w[72 * BLOCK + i] = g[66]
            w[73 * BLOCK + i] = g[67]
            w[74 * BLOCK + i] = g[68]
            w[75 * BLOCK + i] = g[69]
            w[76 * BLOCK + i] = g[70]
            w[77 * BLOCK + i] = g[71]
            w[78 * BLOCK + i] = g[72]
            w[79 * BLOCK + i] = g[73]
            w[80 * BLOCK + i] = g[74]
            w[81 * BLOCK + i] = g[75]
            w[82 * BLOCK + i] = g[76]
            w[83 * BLOCK + i] = g[77]
            w[84 * BLOCK + i] = g[78]
            w[85 * BLOCK + i] = g[79]
            w[86 * BLOCK + i] = g[80]
            w[87 * BLOCK + i] = g[81]
            w[88 * BLOCK + i] = g[82]
            w[89 * BLOCK + i] = g[83]
            w[90 * BLOCK + i] = g[84]
            w[91 * BLOCK + i] = g[85]
            w[92 * BLOCK + i] = g[86]
            w[93 * BLOCK + i] = g[87]
            w[94 * BLOCK + i] = g[88]
            w[95 * BLOCK + i] = g[89]
            w[96 * BLOCK + i] = g[90]
            w[97 * BLOCK + i] = g[91]
            w[98 * BLOCK + i] = g[92]
            w[99 * BLOCK + i] = g[93]
            w[100 * BLOCK + i] = g[94]
            w[101 * BLOCK + i] = g[95]
            w[102 * BLOCK + i] = g[96]
            w[103 * BLOCK + i] = g[97]
            w[104 * BLOCK + i] = g[98]
            w[105 * BLOCK + i] = g[99]
            w[106 * BLOCK + i] = g[100]
            w[107 * BLOCK + i] = g[101]
            w[108 * BLOCK + i] = g[102]
            w[109 * BLOCK + i] = g[103]
            w[110 * BLOCK + i] = g[104]
            w[111 * BLOCK + i] = g[105]
        for k in range(106):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]
