"""Gradients over coefficients, family 6. Written by ``derive.py``: change that."""

# ruff: noqa
# fmt: off

import numpy as np

from tire_pipeline.magic_formula.jit import jitable
from tire_pipeline.magic_formula.ops import (
    absolute, arctan, cos, exp, log, maximum, minimum, power, select, sin, sqrt,
)
from tire_pipeline.magic_formula.unpacking import unpack

BLOCK = 64
STAMP = "e035fcdb3f7e1e55"
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
        "PPX1",
        "PPX2",
        "PPX3",
        "PPX4",
        "RBX3",
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
        "LKYC",
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
        "PKY4",
        "PKY5",
        "PKY6",
        "PKY7",
        "PEY5",
        "PPY1",
        "PPY2",
        "PPY3",
        "PPY4",
        "PPY5",
        "RBY4",
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
        "LKYC",
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
        "PKY4",
        "PKY5",
        "PKY6",
        "PKY7",
        "PEY5",
        "PPY1",
        "PPY2",
        "PPY3",
        "PPY4",
        "PPY5",
        "RBY4",
        "QSX4",
        "QSX5",
        "QSX6",
        "QSX7",
        "QSX8",
        "QSX9",
        "QSX10",
        "QSX11",
        "QSX12",
        "QSX13",
        "QSX14",
        "PPMX1",
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
        "PPX1",
        "PPX2",
        "PPX3",
        "PPX4",
        "RBX3",
        "QSY5",
        "QSY6",
        "QSY7",
        "QSY8",
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
        "LKYC",
        "LKZC",
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
        "PPX1",
        "PPX2",
        "PPX3",
        "PPX4",
        "PKY4",
        "PKY5",
        "PKY6",
        "PKY7",
        "PEY5",
        "PPY1",
        "PPY2",
        "PPY3",
        "PPY4",
        "PPY5",
        "QDZ10",
        "QDZ11",
        "PPZ1",
        "PPZ2",
        "RBX3",
        "RBY4",
    ),
}


@jitable
def fx(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of fx."""
    t0 = p.FNOMIN * p.LFZO
    t1 = fz - t0
    t2 = t1 / t0
    t3 = p.PKX2 * t2
    t4 = p.PKX1 + t3
    t5 = fz * t4
    t6 = p.PKX3 * t2
    t7 = maximum(t6, -700.0)
    t8 = minimum(t7, 100.0)
    t9 = exp(t8)
    t10 = t5 * t9
    t11 = p.PPX1 * dpi
    t12 = 1.0 + t11
    t13 = p.PPX2 * dpi
    t14 = t13 * dpi
    t15 = t12 + t14
    t16 = t10 * t15
    t17 = t16 * p.LKX
    t18 = p.PDX2 * t2
    t19 = p.PDX1 + t18
    t20 = p.PPX3 * dpi
    t21 = 1.0 + t20
    t22 = p.PPX4 * dpi
    t23 = t22 * dpi
    t24 = t21 + t23
    t25 = t19 * t24
    t26 = p.PDX3 * gamma
    t27 = t26 * gamma
    t28 = 1.0 - t27
    t29 = t25 * t28
    t30 = t29 * p.LMUX
    t31 = p.PHX2 * t2
    t32 = p.PHX1 + t31
    t33 = t32 * p.LHX
    t34 = kappa + t33
    t35 = p.PVX2 * t2
    t36 = p.PVX1 + t35
    t37 = fz * t36
    t38 = t37 * p.LVX
    t39 = t38 * p.LMUX
    t40 = p.PCX1 * p.LCX
    t41 = t30 * fz
    t42 = p.PEX2 * t2
    t43 = p.PEX1 + t42
    t44 = p.PEX3 * t2
    t45 = t44 * t2
    t46 = t43 + t45
    t47 = t34 > 0.0
    t48 = t34 < 0.0
    t49 = select(t48, -1.0, 0.0)
    t50 = select(t47, 1.0, t49)
    t51 = p.PEX4 * t50
    t52 = 1.0 - t51
    t53 = t46 * t52
    t54 = t53 * p.LEX
    t55 = t40 * t41
    t56 = t55 == 0.0
    t57 = select(t56, 1.0, t55)
    t58 = t17 / t57
    t59 = select(t56, 0.0, t58)
    t60 = minimum(t54, 1.0)
    t61 = t59 * t34
    t62 = maximum(t61, -1e+150)
    t63 = minimum(t62, 1e+150)
    t64 = 1.0 - t60
    t65 = t64 * t63
    t66 = arctan(t63)
    t67 = t60 * t66
    t68 = t65 + t67
    t69 = arctan(t68)
    t70 = t40 * t69
    t71 = sin(t70)
    t72 = t41 * t71
    t73 = t72 + t39
    t74 = p.RBX3 * gamma
    t75 = t74 * gamma
    t76 = p.RBX1 + t75
    t77 = p.RBX2 * kappa
    t78 = t77 * t77
    t79 = 1.0 + t78
    t80 = sqrt(t79)
    t81 = 1.0 / t80
    t82 = t76 * t81
    t83 = t82 * p.LXAL
    t84 = p.REX2 * t2
    t85 = p.REX1 + t84
    t86 = minimum(t85, 1.0)
    t87 = alpha + p.RHX1
    t88 = t83 * t87
    t89 = maximum(t88, -1e+150)
    t90 = minimum(t89, 1e+150)
    t91 = 1.0 - t86
    t92 = t91 * t90
    t93 = arctan(t90)
    t94 = t86 * t93
    t95 = t92 + t94
    t96 = arctan(t95)
    t97 = p.RCX1 * t96
    t98 = cos(t97)
    t99 = t83 * p.RHX1
    t100 = maximum(t99, -1e+150)
    t101 = minimum(t100, 1e+150)
    t102 = t91 * t101
    t103 = arctan(t101)
    t104 = t86 * t103
    t105 = t102 + t104
    t106 = arctan(t105)
    t107 = p.RCX1 * t106
    t108 = cos(t107)
    t109 = t108 == 0.0
    t110 = select(t109, 1.0, t108)
    t111 = t98 / t110
    t112 = select(t109, 0.0, t111)
    t113 = select(t109, 0.0, t73)
    t114 = t113 / t110
    t115 = t114 * t111
    t116 = -t115
    t117 = select(t109, 0.0, t116)
    t118 = sin(t107)
    t119 = t117 * t118
    t120 = -t119
    t121 = t120 * t106
    t122 = t120 * p.RCX1
    t123 = t105 * t105
    t124 = 1.0 + t123
    t125 = t122 / t124
    t126 = t125 * t103
    t127 = t125 * t86
    t128 = t101 * t101
    t129 = 1.0 + t128
    t130 = t127 / t129
    t131 = t125 * t101
    t132 = t125 * t91
    t133 = t130 + t132
    t134 = t100 < 1e+150
    t135 = select(t134, t133, 0.0)
    t136 = t99 > -1e+150
    t137 = select(t136, t135, 0.0)
    t138 = t137 * p.RHX1
    t139 = t137 * t83
    t140 = sin(t97)
    t141 = t114 * t140
    t142 = -t141
    t143 = t142 * t96
    t144 = t142 * p.RCX1
    t145 = t121 + t143
    t146 = t95 * t95
    t147 = 1.0 + t146
    t148 = t144 / t147
    t149 = t148 * t93
    t150 = t148 * t86
    t151 = t126 + t149
    t152 = t90 * t90
    t153 = 1.0 + t152
    t154 = t150 / t153
    t155 = t148 * t90
    t156 = t148 * t91
    t157 = t131 + t155
    t158 = t154 + t156
    t159 = -t157
    t160 = t151 + t159
    t161 = t89 < 1e+150
    t162 = select(t161, t158, 0.0)
    t163 = t88 > -1e+150
    t164 = select(t163, t162, 0.0)
    t165 = t164 * t87
    t166 = t164 * t83
    t167 = t138 + t165
    t168 = t139 + t166
    t169 = t85 < 1.0
    t170 = select(t169, t160, 0.0)
    t171 = t170 * t2
    t172 = t170 * p.REX2
    t173 = t167 * p.LXAL
    t174 = t167 * t82
    t175 = t173 * t81
    t176 = t173 * t76
    t177 = t176 / t80
    t178 = t177 * t81
    t179 = -t178
    t180 = t80 == 0.0
    t181 = 0.5 * t179
    t182 = t181 / t80
    t183 = select(t180, 0.0, t182)
    t184 = t183 * t77
    t185 = t184 + t184
    t186 = t185 * kappa
    t187 = t175 * gamma
    t188 = t187 * gamma
    t189 = t112 * t71
    t190 = t112 * t41
    t191 = cos(t70)
    t192 = t190 * t191
    t193 = t192 * t69
    t194 = t192 * t40
    t195 = t68 * t68
    t196 = 1.0 + t195
    t197 = t194 / t196
    t198 = t197 * t66
    t199 = t197 * t60
    t200 = t63 * t63
    t201 = 1.0 + t200
    t202 = t199 / t201
    t203 = t197 * t63
    t204 = t197 * t64
    t205 = t202 + t204
    t206 = -t203
    t207 = t198 + t206
    t208 = t62 < 1e+150
    t209 = select(t208, t205, 0.0)
    t210 = t61 > -1e+150
    t211 = select(t210, t209, 0.0)
    t212 = t211 * t34
    t213 = t211 * t59
    t214 = t54 < 1.0
    t215 = select(t214, t207, 0.0)
    t216 = select(t56, 0.0, t212)
    t217 = t216 / t57
    t218 = t217 * t58
    t219 = -t218
    t220 = select(t56, 0.0, t219)
    t221 = t220 * t41
    t222 = t220 * t40
    t223 = t193 + t221
    t224 = t189 + t222
    t225 = t215 * p.LEX
    t226 = t215 * t53
    t227 = t225 * t52
    t228 = t225 * t46
    t229 = -t228
    t230 = t229 * t50
    t231 = t227 * t2
    t232 = t227 * t44
    t233 = t172 + t232
    t234 = t231 * t2
    t235 = t231 * p.PEX3
    t236 = t233 + t235
    t237 = t227 * p.PEX2
    t238 = t236 + t237
    t239 = t224 * fz
    t240 = t223 * p.LCX
    t241 = t223 * p.PCX1
    t242 = t112 * p.LMUX
    t243 = t112 * t38
    t244 = t242 * p.LVX
    t245 = t242 * t37
    t246 = t244 * fz
    t247 = t246 * t2
    t248 = t246 * p.PVX2
    t249 = t238 + t248
    t250 = t213 * p.LHX
    t251 = t213 * t32
    t252 = t250 * t2
    t253 = t250 * p.PHX2
    t254 = t249 + t253
    t255 = t239 * p.LMUX
    t256 = t239 * t29
    t257 = t243 + t256
    t258 = t255 * t28
    t259 = t255 * t25
    t260 = -t259
    t261 = t260 * gamma
    t262 = t261 * gamma
    t263 = t258 * t24
    t264 = t258 * t19
    t265 = t264 * dpi
    t266 = t265 * dpi
    t267 = t263 * t2
    t268 = t263 * p.PDX2
    t269 = t254 + t268
    t270 = t217 * p.LKX
    t271 = t217 * t16
    t272 = t270 * t15
    t273 = t270 * t10
    t274 = t273 * dpi
    t275 = t274 * dpi
    t276 = t272 * t9
    t277 = t272 * t5
    t278 = t277 * t9
    t279 = t7 < 100.0
    t280 = select(t279, t278, 0.0)
    t281 = t6 > -700.0
    t282 = select(t281, t280, 0.0)
    t283 = t282 * t2
    t284 = t282 * p.PKX3
    t285 = t269 + t284
    t286 = t276 * fz
    t287 = t286 * t2
    t288 = t286 * p.PKX2
    t289 = t285 + t288
    t290 = t289 / t0
    t291 = t290 * t2
    t292 = -t291
    t293 = -t290
    t294 = t292 + t293
    t295 = t294 * p.LFZO
    t296 = t294 * p.FNOMIN
    return (
        t295,
        t296,
        t241,
        t257,
        t226,
        t271,
        t251,
        t245,
        t174,
        t240,
        t263,
        t267,
        t262,
        t227,
        t231,
        t234,
        t230,
        t286,
        t287,
        t283,
        t250,
        t252,
        t246,
        t247,
        t175,
        t186,
        t145,
        t170,
        t171,
        t168,
        t274,
        t275,
        t265,
        t266,
        t188,
    )


def loop_fx(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of fx; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(41 * BLOCK)
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
            w[37 * BLOCK + i] = g[31]
            w[38 * BLOCK + i] = g[32]
            w[39 * BLOCK + i] = g[33]
            w[40 * BLOCK + i] = g[34]
        for k in range(35):
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
    t3 = fz / t0
    t4 = p.PKY5 * gamma
    t5 = t4 * gamma
    t6 = p.PKY2 + t5
    t7 = p.PPY2 * dpi
    t8 = 1.0 + t7
    t9 = t6 * t8
    t10 = t9 == 0.0
    t11 = select(t10, 1.0, t9)
    t12 = t3 / t11
    t13 = select(t10, 0.0, t12)
    t14 = p.PKY1 * t0
    t15 = p.PPY1 * dpi
    t16 = 1.0 + t15
    t17 = t14 * t16
    t18 = absolute(gamma)
    t19 = p.PKY3 * t18
    t20 = 1.0 - t19
    t21 = t17 * t20
    t22 = arctan(t13)
    t23 = p.PKY4 * t22
    t24 = sin(t23)
    t25 = t21 * t24
    t26 = t25 * p.LKY
    t27 = p.PVY4 * t2
    t28 = p.PVY3 + t27
    t29 = fz * t28
    t30 = t29 * gamma
    t31 = t30 * p.LKYC
    t32 = t31 * p.LMUY
    t33 = p.PDY2 * t2
    t34 = p.PDY1 + t33
    t35 = p.PPY3 * dpi
    t36 = 1.0 + t35
    t37 = p.PPY4 * dpi
    t38 = t37 * dpi
    t39 = t36 + t38
    t40 = t34 * t39
    t41 = p.PDY3 * gamma
    t42 = t41 * gamma
    t43 = 1.0 - t42
    t44 = t40 * t43
    t45 = t44 * p.LMUY
    t46 = p.PKY7 * t2
    t47 = p.PKY6 + t46
    t48 = fz * t47
    t49 = p.PPY5 * dpi
    t50 = 1.0 + t49
    t51 = t48 * t50
    t52 = t51 * p.LKYC
    t53 = t52 * gamma
    t54 = t53 - t32
    t55 = t26 == 0.0
    t56 = select(t55, 1.0, t26)
    t57 = t54 / t56
    t58 = select(t55, 0.0, t57)
    t59 = p.PHY2 * t2
    t60 = p.PHY1 + t59
    t61 = t60 * p.LHY
    t62 = t61 + t58
    t63 = t62 + 1.0
    t64 = t63 - 1.0
    t65 = p.PVY2 * t2
    t66 = p.PVY1 + t65
    t67 = fz * t66
    t68 = t67 * p.LVY
    t69 = t68 * p.LMUY
    t70 = t69 + t32
    t71 = alpha + t64
    t72 = p.PCY1 * p.LCY
    t73 = t45 * fz
    t74 = p.PEY2 * t2
    t75 = p.PEY1 + t74
    t76 = p.PEY5 * gamma
    t77 = t76 * gamma
    t78 = 1.0 + t77
    t79 = p.PEY4 * gamma
    t80 = p.PEY3 + t79
    t81 = t71 > 0.0
    t82 = t71 < 0.0
    t83 = select(t82, -1.0, 0.0)
    t84 = select(t81, 1.0, t83)
    t85 = t80 * t84
    t86 = t78 - t85
    t87 = t75 * t86
    t88 = t87 * p.LEY
    t89 = t72 * t73
    t90 = t89 == 0.0
    t91 = select(t90, 1.0, t89)
    t92 = t26 / t91
    t93 = select(t90, 0.0, t92)
    t94 = minimum(t88, 1.0)
    t95 = t93 * t71
    t96 = maximum(t95, -1e+150)
    t97 = minimum(t96, 1e+150)
    t98 = 1.0 - t94
    t99 = t98 * t97
    t100 = arctan(t97)
    t101 = t94 * t100
    t102 = t99 + t101
    t103 = arctan(t102)
    t104 = t72 * t103
    t105 = sin(t104)
    t106 = t73 * t105
    t107 = t106 + t70
    t108 = p.RBY4 * gamma
    t109 = t108 * gamma
    t110 = p.RBY1 + t109
    t111 = alpha - p.RBY3
    t112 = p.RBY2 * t111
    t113 = t112 * t112
    t114 = 1.0 + t113
    t115 = sqrt(t114)
    t116 = 1.0 / t115
    t117 = t110 * t116
    t118 = t117 * p.LYKA
    t119 = p.REY2 * t2
    t120 = p.REY1 + t119
    t121 = minimum(t120, 1.0)
    t122 = p.RHY2 * t2
    t123 = p.RHY1 + t122
    t124 = kappa + t123
    t125 = t118 * t124
    t126 = maximum(t125, -1e+150)
    t127 = minimum(t126, 1e+150)
    t128 = 1.0 - t121
    t129 = t128 * t127
    t130 = arctan(t127)
    t131 = t121 * t130
    t132 = t129 + t131
    t133 = arctan(t132)
    t134 = p.RCY1 * t133
    t135 = cos(t134)
    t136 = t118 * t123
    t137 = maximum(t136, -1e+150)
    t138 = minimum(t137, 1e+150)
    t139 = t128 * t138
    t140 = arctan(t138)
    t141 = t121 * t140
    t142 = t139 + t141
    t143 = arctan(t142)
    t144 = p.RCY1 * t143
    t145 = cos(t144)
    t146 = t145 == 0.0
    t147 = select(t146, 1.0, t145)
    t148 = t135 / t147
    t149 = select(t146, 0.0, t148)
    t150 = p.RVY2 * t2
    t151 = p.RVY1 + t150
    t152 = p.RVY3 * gamma
    t153 = t151 + t152
    t154 = t73 * t153
    t155 = p.RVY4 * alpha
    t156 = t155 * t155
    t157 = 1.0 + t156
    t158 = sqrt(t157)
    t159 = 1.0 / t158
    t160 = t154 * t159
    t161 = p.RVY6 * kappa
    t162 = arctan(t161)
    t163 = p.RVY5 * t162
    t164 = sin(t163)
    t165 = t160 * t164
    t166 = p.LVYKA * t164
    t167 = p.LVYKA * t160
    t168 = cos(t163)
    t169 = t167 * t168
    t170 = t169 * t162
    t171 = t169 * p.RVY5
    t172 = t161 * t161
    t173 = 1.0 + t172
    t174 = t171 / t173
    t175 = t174 * kappa
    t176 = t166 * t159
    t177 = t166 * t154
    t178 = t177 / t158
    t179 = t178 * t159
    t180 = -t179
    t181 = t158 == 0.0
    t182 = 0.5 * t180
    t183 = t182 / t158
    t184 = select(t181, 0.0, t183)
    t185 = t184 * t155
    t186 = t185 + t185
    t187 = t186 * alpha
    t188 = t176 * t153
    t189 = t176 * t73
    t190 = t189 * gamma
    t191 = t189 * t2
    t192 = t189 * p.RVY2
    t193 = select(t146, 0.0, t107)
    t194 = t193 / t147
    t195 = t194 * t148
    t196 = -t195
    t197 = select(t146, 0.0, t196)
    t198 = sin(t144)
    t199 = t197 * t198
    t200 = -t199
    t201 = t200 * t143
    t202 = t200 * p.RCY1
    t203 = t142 * t142
    t204 = 1.0 + t203
    t205 = t202 / t204
    t206 = t205 * t140
    t207 = t205 * t121
    t208 = t138 * t138
    t209 = 1.0 + t208
    t210 = t207 / t209
    t211 = t205 * t138
    t212 = t205 * t128
    t213 = t210 + t212
    t214 = t137 < 1e+150
    t215 = select(t214, t213, 0.0)
    t216 = t136 > -1e+150
    t217 = select(t216, t215, 0.0)
    t218 = t217 * t123
    t219 = t217 * t118
    t220 = sin(t134)
    t221 = t194 * t220
    t222 = -t221
    t223 = t222 * t133
    t224 = t222 * p.RCY1
    t225 = t201 + t223
    t226 = t132 * t132
    t227 = 1.0 + t226
    t228 = t224 / t227
    t229 = t228 * t130
    t230 = t228 * t121
    t231 = t206 + t229
    t232 = t127 * t127
    t233 = 1.0 + t232
    t234 = t230 / t233
    t235 = t228 * t127
    t236 = t228 * t128
    t237 = t211 + t235
    t238 = t234 + t236
    t239 = -t237
    t240 = t231 + t239
    t241 = t126 < 1e+150
    t242 = select(t241, t238, 0.0)
    t243 = t125 > -1e+150
    t244 = select(t243, t242, 0.0)
    t245 = t244 * t124
    t246 = t244 * t118
    t247 = t218 + t245
    t248 = t219 + t246
    t249 = t248 * t2
    t250 = t248 * p.RHY2
    t251 = t192 + t250
    t252 = t120 < 1.0
    t253 = select(t252, t240, 0.0)
    t254 = t253 * t2
    t255 = t253 * p.REY2
    t256 = t251 + t255
    t257 = t247 * p.LYKA
    t258 = t247 * t117
    t259 = t257 * t116
    t260 = t257 * t110
    t261 = t260 / t115
    t262 = t261 * t116
    t263 = -t262
    t264 = t115 == 0.0
    t265 = 0.5 * t263
    t266 = t265 / t115
    t267 = select(t264, 0.0, t266)
    t268 = t267 * t112
    t269 = t268 + t268
    t270 = t269 * t111
    t271 = t269 * p.RBY2
    t272 = -t271
    t273 = t259 * gamma
    t274 = t273 * gamma
    t275 = t149 * t105
    t276 = t149 * t73
    t277 = t188 + t275
    t278 = cos(t104)
    t279 = t276 * t278
    t280 = t279 * t103
    t281 = t279 * t72
    t282 = t102 * t102
    t283 = 1.0 + t282
    t284 = t281 / t283
    t285 = t284 * t100
    t286 = t284 * t94
    t287 = t97 * t97
    t288 = 1.0 + t287
    t289 = t286 / t288
    t290 = t284 * t97
    t291 = t284 * t98
    t292 = t289 + t291
    t293 = -t290
    t294 = t285 + t293
    t295 = t96 < 1e+150
    t296 = select(t295, t292, 0.0)
    t297 = t95 > -1e+150
    t298 = select(t297, t296, 0.0)
    t299 = t298 * t71
    t300 = t298 * t93
    t301 = t88 < 1.0
    t302 = select(t301, t294, 0.0)
    t303 = select(t90, 0.0, t299)
    t304 = t303 / t91
    t305 = t304 * t92
    t306 = -t305
    t307 = select(t90, 0.0, t306)
    t308 = t307 * t73
    t309 = t307 * t72
    t310 = t280 + t308
    t311 = t277 + t309
    t312 = t302 * p.LEY
    t313 = t302 * t87
    t314 = t312 * t86
    t315 = t312 * t75
    t316 = -t315
    t317 = t316 * t84
    t318 = t317 * gamma
    t319 = t315 * gamma
    t320 = t319 * gamma
    t321 = t314 * t2
    t322 = t314 * p.PEY2
    t323 = t256 + t322
    t324 = t311 * fz
    t325 = t310 * p.LCY
    t326 = t310 * p.PCY1
    t327 = t149 * p.LMUY
    t328 = t149 * t68
    t329 = t327 * p.LVY
    t330 = t327 * t67
    t331 = t329 * fz
    t332 = t331 * t2
    t333 = t331 * p.PVY2
    t334 = t323 + t333
    t335 = t300 * p.LHY
    t336 = t300 * t60
    t337 = t335 * t2
    t338 = t335 * p.PHY2
    t339 = t334 + t338
    t340 = select(t55, 0.0, t300)
    t341 = t340 / t56
    t342 = t341 * t57
    t343 = -t342
    t344 = select(t55, 0.0, t343)
    t345 = t304 + t344
    t346 = -t341
    t347 = t149 + t346
    t348 = t341 * gamma
    t349 = t348 * p.LKYC
    t350 = t348 * t51
    t351 = t349 * t50
    t352 = t349 * t48
    t353 = t352 * dpi
    t354 = t351 * fz
    t355 = t354 * t2
    t356 = t354 * p.PKY7
    t357 = t339 + t356
    t358 = t324 * p.LMUY
    t359 = t324 * t44
    t360 = t328 + t359
    t361 = t358 * t43
    t362 = t358 * t40
    t363 = -t362
    t364 = t363 * gamma
    t365 = t364 * gamma
    t366 = t361 * t39
    t367 = t361 * t34
    t368 = t367 * dpi
    t369 = t368 * dpi
    t370 = t366 * t2
    t371 = t366 * p.PDY2
    t372 = t357 + t371
    t373 = t347 * p.LMUY
    t374 = t347 * t31
    t375 = t360 + t374
    t376 = t373 * p.LKYC
    t377 = t373 * t30
    t378 = t350 + t377
    t379 = t376 * gamma
    t380 = t379 * fz
    t381 = t380 * t2
    t382 = t380 * p.PVY4
    t383 = t372 + t382
    t384 = t345 * p.LKY
    t385 = t345 * t25
    t386 = t384 * t24
    t387 = t384 * t21
    t388 = cos(t23)
    t389 = t387 * t388
    t390 = t389 * t22
    t391 = t389 * p.PKY4
    t392 = t13 * t13
    t393 = 1.0 + t392
    t394 = t391 / t393
    t395 = t386 * t20
    t396 = t386 * t17
    t397 = -t396
    t398 = t397 * t18
    t399 = t395 * t16
    t400 = t395 * t14
    t401 = t400 * dpi
    t402 = t399 * t0
    t403 = t399 * p.PKY1
    t404 = select(t10, 0.0, t394)
    t405 = t404 / t11
    t406 = t405 * t12
    t407 = -t406
    t408 = select(t10, 0.0, t407)
    t409 = t408 * t8
    t410 = t408 * t6
    t411 = t410 * dpi
    t412 = t409 * gamma
    t413 = t412 * gamma
    t414 = t405 / t0
    t415 = t414 * t3
    t416 = -t415
    t417 = t403 + t416
    t418 = t383 / t0
    t419 = t418 * t2
    t420 = -t419
    t421 = t417 + t420
    t422 = -t418
    t423 = t421 + t422
    t424 = t423 * p.LFZO
    t425 = t423 * p.FNOMIN
    return (
        t424,
        t425,
        t326,
        t375,
        t313,
        t385,
        t336,
        t330,
        t258,
        t165,
        t378,
        t325,
        t366,
        t370,
        t365,
        t314,
        t321,
        t317,
        t318,
        t402,
        t409,
        t398,
        t335,
        t337,
        t331,
        t332,
        t380,
        t381,
        t259,
        t270,
        t272,
        t225,
        t253,
        t254,
        t248,
        t249,
        t189,
        t191,
        t190,
        t187,
        t170,
        t175,
        t390,
        t413,
        t354,
        t355,
        t320,
        t401,
        t411,
        t368,
        t369,
        t353,
        t274,
    )


def loop_fy(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of fy; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(59 * BLOCK)
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
        for k in range(53):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]


@jitable
def mx(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of mx."""
    t0 = fz / p.FNOMIN
    t1 = p.FNOMIN * p.LFZO
    t2 = fz - t1
    t3 = t2 / t1
    t4 = fz / t1
    t5 = p.PKY5 * gamma
    t6 = t5 * gamma
    t7 = p.PKY2 + t6
    t8 = p.PPY2 * dpi
    t9 = 1.0 + t8
    t10 = t7 * t9
    t11 = t10 == 0.0
    t12 = select(t11, 1.0, t10)
    t13 = t4 / t12
    t14 = select(t11, 0.0, t13)
    t15 = p.PKY1 * t1
    t16 = p.PPY1 * dpi
    t17 = 1.0 + t16
    t18 = t15 * t17
    t19 = absolute(gamma)
    t20 = p.PKY3 * t19
    t21 = 1.0 - t20
    t22 = t18 * t21
    t23 = arctan(t14)
    t24 = p.PKY4 * t23
    t25 = sin(t24)
    t26 = t22 * t25
    t27 = t26 * p.LKY
    t28 = p.PVY4 * t3
    t29 = p.PVY3 + t28
    t30 = fz * t29
    t31 = t30 * gamma
    t32 = t31 * p.LKYC
    t33 = t32 * p.LMUY
    t34 = p.PDY2 * t3
    t35 = p.PDY1 + t34
    t36 = p.PPY3 * dpi
    t37 = 1.0 + t36
    t38 = p.PPY4 * dpi
    t39 = t38 * dpi
    t40 = t37 + t39
    t41 = t35 * t40
    t42 = p.PDY3 * gamma
    t43 = t42 * gamma
    t44 = 1.0 - t43
    t45 = t41 * t44
    t46 = t45 * p.LMUY
    t47 = p.PKY7 * t3
    t48 = p.PKY6 + t47
    t49 = fz * t48
    t50 = p.PPY5 * dpi
    t51 = 1.0 + t50
    t52 = t49 * t51
    t53 = t52 * p.LKYC
    t54 = t53 * gamma
    t55 = t54 - t33
    t56 = t27 == 0.0
    t57 = select(t56, 1.0, t27)
    t58 = t55 / t57
    t59 = select(t56, 0.0, t58)
    t60 = p.PHY2 * t3
    t61 = p.PHY1 + t60
    t62 = t61 * p.LHY
    t63 = t62 + t59
    t64 = t63 + 1.0
    t65 = t64 - 1.0
    t66 = p.PVY2 * t3
    t67 = p.PVY1 + t66
    t68 = fz * t67
    t69 = t68 * p.LVY
    t70 = t69 * p.LMUY
    t71 = t70 + t33
    t72 = alpha + t65
    t73 = p.PCY1 * p.LCY
    t74 = t46 * fz
    t75 = p.PEY2 * t3
    t76 = p.PEY1 + t75
    t77 = p.PEY5 * gamma
    t78 = t77 * gamma
    t79 = 1.0 + t78
    t80 = p.PEY4 * gamma
    t81 = p.PEY3 + t80
    t82 = t72 > 0.0
    t83 = t72 < 0.0
    t84 = select(t83, -1.0, 0.0)
    t85 = select(t82, 1.0, t84)
    t86 = t81 * t85
    t87 = t79 - t86
    t88 = t76 * t87
    t89 = t88 * p.LEY
    t90 = t73 * t74
    t91 = t90 == 0.0
    t92 = select(t91, 1.0, t90)
    t93 = t27 / t92
    t94 = select(t91, 0.0, t93)
    t95 = minimum(t89, 1.0)
    t96 = t94 * t72
    t97 = maximum(t96, -1e+150)
    t98 = minimum(t97, 1e+150)
    t99 = 1.0 - t95
    t100 = t99 * t98
    t101 = arctan(t98)
    t102 = t95 * t101
    t103 = t100 + t102
    t104 = arctan(t103)
    t105 = t73 * t104
    t106 = sin(t105)
    t107 = t74 * t106
    t108 = t107 + t71
    t109 = p.RBY4 * gamma
    t110 = t109 * gamma
    t111 = p.RBY1 + t110
    t112 = alpha - p.RBY3
    t113 = p.RBY2 * t112
    t114 = t113 * t113
    t115 = 1.0 + t114
    t116 = sqrt(t115)
    t117 = 1.0 / t116
    t118 = t111 * t117
    t119 = t118 * p.LYKA
    t120 = p.REY2 * t3
    t121 = p.REY1 + t120
    t122 = minimum(t121, 1.0)
    t123 = p.RHY2 * t3
    t124 = p.RHY1 + t123
    t125 = kappa + t124
    t126 = t119 * t125
    t127 = maximum(t126, -1e+150)
    t128 = minimum(t127, 1e+150)
    t129 = 1.0 - t122
    t130 = t129 * t128
    t131 = arctan(t128)
    t132 = t122 * t131
    t133 = t130 + t132
    t134 = arctan(t133)
    t135 = p.RCY1 * t134
    t136 = cos(t135)
    t137 = t119 * t124
    t138 = maximum(t137, -1e+150)
    t139 = minimum(t138, 1e+150)
    t140 = t129 * t139
    t141 = arctan(t139)
    t142 = t122 * t141
    t143 = t140 + t142
    t144 = arctan(t143)
    t145 = p.RCY1 * t144
    t146 = cos(t145)
    t147 = t146 == 0.0
    t148 = select(t147, 1.0, t146)
    t149 = t136 / t148
    t150 = select(t147, 0.0, t149)
    t151 = t108 * t150
    t152 = p.RVY2 * t3
    t153 = p.RVY1 + t152
    t154 = p.RVY3 * gamma
    t155 = t153 + t154
    t156 = t74 * t155
    t157 = p.RVY4 * alpha
    t158 = t157 * t157
    t159 = 1.0 + t158
    t160 = sqrt(t159)
    t161 = 1.0 / t160
    t162 = t156 * t161
    t163 = p.RVY6 * kappa
    t164 = arctan(t163)
    t165 = p.RVY5 * t164
    t166 = sin(t165)
    t167 = t162 * t166
    t168 = t167 * p.LVYKA
    t169 = t151 + t168
    t170 = t169 / p.FNOMIN
    t171 = p.QSX6 * t0
    t172 = p.QSX1 * p.LVMX
    t173 = p.QSX2 * gamma
    t174 = p.PPMX1 * dpi
    t175 = 1.0 + t174
    t176 = t173 * t175
    t177 = t172 - t176
    t178 = p.QSX12 * gamma
    t179 = t178 * t19
    t180 = t177 - t179
    t181 = p.QSX3 * t170
    t182 = t180 + t181
    t183 = t171 * t171
    t184 = arctan(t183)
    t185 = p.QSX5 * t184
    t186 = cos(t185)
    t187 = p.QSX4 * t186
    t188 = p.QSX7 * gamma
    t189 = p.QSX9 * t170
    t190 = arctan(t189)
    t191 = p.QSX8 * t190
    t192 = t188 + t191
    t193 = sin(t192)
    t194 = t187 * t193
    t195 = t182 + t194
    t196 = p.QSX11 * t0
    t197 = arctan(t196)
    t198 = p.QSX10 * t197
    t199 = t198 * gamma
    t200 = t195 + t199
    t201 = p.UNLOADED_RADIUS * p.LMX
    t202 = fz * t200
    t203 = p.QSX14 * t19
    t204 = p.QSX13 + t203
    t205 = t169 * t204
    t206 = t202 + t205
    t207 = cos(t165)
    t208 = t163 * t163
    t209 = 1.0 + t208
    t210 = t160 == 0.0
    t211 = sin(t145)
    t212 = t143 * t143
    t213 = 1.0 + t212
    t214 = t139 * t139
    t215 = 1.0 + t214
    t216 = t138 < 1e+150
    t217 = t137 > -1e+150
    t218 = sin(t135)
    t219 = t133 * t133
    t220 = 1.0 + t219
    t221 = t128 * t128
    t222 = 1.0 + t221
    t223 = t127 < 1e+150
    t224 = t126 > -1e+150
    t225 = t121 < 1.0
    t226 = t116 == 0.0
    t227 = cos(t105)
    t228 = t103 * t103
    t229 = 1.0 + t228
    t230 = t98 * t98
    t231 = 1.0 + t230
    t232 = t97 < 1e+150
    t233 = t96 > -1e+150
    t234 = t89 < 1.0
    t235 = cos(t24)
    t236 = t14 * t14
    t237 = 1.0 + t236
    t238 = t201 * t204
    t239 = t201 * t169
    t240 = t239 * t19
    t241 = t201 * fz
    t242 = t206 * p.LMX
    t243 = t206 * p.UNLOADED_RADIUS
    t244 = t241 * gamma
    t245 = t244 * t197
    t246 = t244 * p.QSX10
    t247 = t196 * t196
    t248 = 1.0 + t247
    t249 = t246 / t248
    t250 = t249 * t0
    t251 = t249 * p.QSX11
    t252 = t241 * t193
    t253 = t241 * t187
    t254 = cos(t192)
    t255 = t253 * t254
    t256 = t255 * t190
    t257 = t255 * p.QSX8
    t258 = t189 * t189
    t259 = 1.0 + t258
    t260 = t257 / t259
    t261 = t260 * t170
    t262 = t260 * p.QSX9
    t263 = t255 * gamma
    t264 = t252 * t186
    t265 = t252 * p.QSX4
    t266 = sin(t185)
    t267 = t265 * t266
    t268 = -t267
    t269 = t268 * t184
    t270 = t268 * p.QSX5
    t271 = t183 * t183
    t272 = 1.0 + t271
    t273 = t270 / t272
    t274 = t273 * t171
    t275 = t274 + t274
    t276 = t241 * t170
    t277 = t241 * p.QSX3
    t278 = t262 + t277
    t279 = -t241
    t280 = t279 * t19
    t281 = t280 * gamma
    t282 = t279 * t175
    t283 = t279 * t173
    t284 = t283 * dpi
    t285 = t282 * gamma
    t286 = t241 * p.LVMX
    t287 = t241 * p.QSX1
    t288 = t275 * t0
    t289 = t275 * p.QSX6
    t290 = t251 + t289
    t291 = t278 / p.FNOMIN
    t292 = t291 * t170
    t293 = -t292
    t294 = t238 + t291
    t295 = t294 * p.LVYKA
    t296 = t294 * t167
    t297 = t295 * t166
    t298 = t295 * t162
    t299 = t298 * t207
    t300 = t299 * t164
    t301 = t299 * p.RVY5
    t302 = t301 / t209
    t303 = t302 * kappa
    t304 = t297 * t161
    t305 = t297 * t156
    t306 = t305 / t160
    t307 = t306 * t161
    t308 = -t307
    t309 = 0.5 * t308
    t310 = t309 / t160
    t311 = select(t210, 0.0, t310)
    t312 = t311 * t157
    t313 = t312 + t312
    t314 = t313 * alpha
    t315 = t304 * t155
    t316 = t304 * t74
    t317 = t316 * gamma
    t318 = t316 * t3
    t319 = t316 * p.RVY2
    t320 = t294 * t150
    t321 = t294 * t108
    t322 = select(t147, 0.0, t321)
    t323 = t322 / t148
    t324 = t323 * t149
    t325 = -t324
    t326 = select(t147, 0.0, t325)
    t327 = t326 * t211
    t328 = -t327
    t329 = t328 * t144
    t330 = t328 * p.RCY1
    t331 = t330 / t213
    t332 = t331 * t141
    t333 = t331 * t122
    t334 = t333 / t215
    t335 = t331 * t139
    t336 = t331 * t129
    t337 = t334 + t336
    t338 = select(t216, t337, 0.0)
    t339 = select(t217, t338, 0.0)
    t340 = t339 * t124
    t341 = t339 * t119
    t342 = t323 * t218
    t343 = -t342
    t344 = t343 * t134
    t345 = t343 * p.RCY1
    t346 = t329 + t344
    t347 = t345 / t220
    t348 = t347 * t131
    t349 = t347 * t122
    t350 = t332 + t348
    t351 = t349 / t222
    t352 = t347 * t128
    t353 = t347 * t129
    t354 = t335 + t352
    t355 = t351 + t353
    t356 = -t354
    t357 = t350 + t356
    t358 = select(t223, t355, 0.0)
    t359 = select(t224, t358, 0.0)
    t360 = t359 * t125
    t361 = t359 * t119
    t362 = t340 + t360
    t363 = t341 + t361
    t364 = t363 * t3
    t365 = t363 * p.RHY2
    t366 = t319 + t365
    t367 = select(t225, t357, 0.0)
    t368 = t367 * t3
    t369 = t367 * p.REY2
    t370 = t366 + t369
    t371 = t362 * p.LYKA
    t372 = t362 * t118
    t373 = t371 * t117
    t374 = t371 * t111
    t375 = t374 / t116
    t376 = t375 * t117
    t377 = -t376
    t378 = 0.5 * t377
    t379 = t378 / t116
    t380 = select(t226, 0.0, t379)
    t381 = t380 * t113
    t382 = t381 + t381
    t383 = t382 * t112
    t384 = t382 * p.RBY2
    t385 = -t384
    t386 = t373 * gamma
    t387 = t386 * gamma
    t388 = t320 * t106
    t389 = t320 * t74
    t390 = t315 + t388
    t391 = t389 * t227
    t392 = t391 * t104
    t393 = t391 * t73
    t394 = t393 / t229
    t395 = t394 * t101
    t396 = t394 * t95
    t397 = t396 / t231
    t398 = t394 * t98
    t399 = t394 * t99
    t400 = t397 + t399
    t401 = -t398
    t402 = t395 + t401
    t403 = select(t232, t400, 0.0)
    t404 = select(t233, t403, 0.0)
    t405 = t404 * t72
    t406 = t404 * t94
    t407 = select(t234, t402, 0.0)
    t408 = select(t91, 0.0, t405)
    t409 = t408 / t92
    t410 = t409 * t93
    t411 = -t410
    t412 = select(t91, 0.0, t411)
    t413 = t412 * t74
    t414 = t412 * t73
    t415 = t392 + t413
    t416 = t390 + t414
    t417 = t407 * p.LEY
    t418 = t407 * t88
    t419 = t417 * t87
    t420 = t417 * t76
    t421 = -t420
    t422 = t421 * t85
    t423 = t422 * gamma
    t424 = t420 * gamma
    t425 = t424 * gamma
    t426 = t419 * t3
    t427 = t419 * p.PEY2
    t428 = t370 + t427
    t429 = t416 * fz
    t430 = t415 * p.LCY
    t431 = t415 * p.PCY1
    t432 = t320 * p.LMUY
    t433 = t320 * t69
    t434 = t432 * p.LVY
    t435 = t432 * t68
    t436 = t434 * fz
    t437 = t436 * t3
    t438 = t436 * p.PVY2
    t439 = t428 + t438
    t440 = t406 * p.LHY
    t441 = t406 * t61
    t442 = t440 * t3
    t443 = t440 * p.PHY2
    t444 = t439 + t443
    t445 = select(t56, 0.0, t406)
    t446 = t445 / t57
    t447 = t446 * t58
    t448 = -t447
    t449 = select(t56, 0.0, t448)
    t450 = t409 + t449
    t451 = -t446
    t452 = t320 + t451
    t453 = t446 * gamma
    t454 = t453 * p.LKYC
    t455 = t453 * t52
    t456 = t454 * t51
    t457 = t454 * t49
    t458 = t457 * dpi
    t459 = t456 * fz
    t460 = t459 * t3
    t461 = t459 * p.PKY7
    t462 = t444 + t461
    t463 = t429 * p.LMUY
    t464 = t429 * t45
    t465 = t433 + t464
    t466 = t463 * t44
    t467 = t463 * t41
    t468 = -t467
    t469 = t468 * gamma
    t470 = t469 * gamma
    t471 = t466 * t40
    t472 = t466 * t35
    t473 = t472 * dpi
    t474 = t473 * dpi
    t475 = t471 * t3
    t476 = t471 * p.PDY2
    t477 = t462 + t476
    t478 = t452 * p.LMUY
    t479 = t452 * t32
    t480 = t465 + t479
    t481 = t478 * p.LKYC
    t482 = t478 * t31
    t483 = t455 + t482
    t484 = t481 * gamma
    t485 = t484 * fz
    t486 = t485 * t3
    t487 = t485 * p.PVY4
    t488 = t477 + t487
    t489 = t450 * p.LKY
    t490 = t450 * t26
    t491 = t489 * t25
    t492 = t489 * t22
    t493 = t492 * t235
    t494 = t493 * t23
    t495 = t493 * p.PKY4
    t496 = t495 / t237
    t497 = t491 * t21
    t498 = t491 * t18
    t499 = -t498
    t500 = t499 * t19
    t501 = t497 * t17
    t502 = t497 * t15
    t503 = t502 * dpi
    t504 = t501 * t1
    t505 = t501 * p.PKY1
    t506 = select(t11, 0.0, t496)
    t507 = t506 / t12
    t508 = t507 * t13
    t509 = -t508
    t510 = select(t11, 0.0, t509)
    t511 = t510 * t9
    t512 = t510 * t7
    t513 = t512 * dpi
    t514 = t511 * gamma
    t515 = t514 * gamma
    t516 = t507 / t1
    t517 = t516 * t4
    t518 = -t517
    t519 = t505 + t518
    t520 = t488 / t1
    t521 = t520 * t3
    t522 = -t521
    t523 = t519 + t522
    t524 = -t520
    t525 = t523 + t524
    t526 = t525 * p.LFZO
    t527 = t525 * p.FNOMIN
    t528 = t293 + t526
    t529 = t290 / p.FNOMIN
    t530 = t529 * t0
    t531 = -t530
    t532 = t528 + t531
    return (
        t532,
        t242,
        t527,
        t431,
        t480,
        t418,
        t490,
        t441,
        t435,
        t372,
        t296,
        t243,
        t287,
        t483,
        t430,
        t471,
        t475,
        t470,
        t419,
        t426,
        t422,
        t423,
        t504,
        t511,
        t500,
        t440,
        t442,
        t436,
        t437,
        t485,
        t486,
        t373,
        t383,
        t385,
        t346,
        t367,
        t368,
        t363,
        t364,
        t316,
        t318,
        t317,
        t314,
        t300,
        t303,
        t286,
        t285,
        t276,
        t494,
        t515,
        t459,
        t460,
        t425,
        t503,
        t513,
        t473,
        t474,
        t458,
        t387,
        t264,
        t269,
        t288,
        t263,
        t256,
        t261,
        t245,
        t250,
        t281,
        t239,
        t240,
        t284,
    )


def loop_mx(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of mx; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(77 * BLOCK)
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
        for k in range(71):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]


@jitable
def my(p, alpha, kappa, gamma, fz, speed, dpi):
    """Return the gradient of my."""
    t0 = 1.0 + dpi
    t1 = maximum(t0, 1e-06)
    t2 = fz / p.FNOMIN
    t3 = power(t2, p.QSY7)
    t4 = power(t1, p.QSY8)
    t5 = t3 * t4
    t6 = p.FNOMIN * p.LFZO
    t7 = fz - t6
    t8 = t7 / t6
    t9 = speed < 0.0
    t10 = p.PKX2 * t8
    t11 = p.PKX1 + t10
    t12 = fz * t11
    t13 = p.PKX3 * t8
    t14 = maximum(t13, -700.0)
    t15 = minimum(t14, 100.0)
    t16 = exp(t15)
    t17 = t12 * t16
    t18 = p.PPX1 * dpi
    t19 = 1.0 + t18
    t20 = p.PPX2 * dpi
    t21 = t20 * dpi
    t22 = t19 + t21
    t23 = t17 * t22
    t24 = t23 * p.LKX
    t25 = p.PDX2 * t8
    t26 = p.PDX1 + t25
    t27 = p.PPX3 * dpi
    t28 = 1.0 + t27
    t29 = p.PPX4 * dpi
    t30 = t29 * dpi
    t31 = t28 + t30
    t32 = t26 * t31
    t33 = p.PDX3 * gamma
    t34 = t33 * gamma
    t35 = 1.0 - t34
    t36 = t32 * t35
    t37 = t36 * p.LMUX
    t38 = p.PHX2 * t8
    t39 = p.PHX1 + t38
    t40 = t39 * p.LHX
    t41 = kappa + t40
    t42 = p.PVX2 * t8
    t43 = p.PVX1 + t42
    t44 = fz * t43
    t45 = t44 * p.LVX
    t46 = t45 * p.LMUX
    t47 = p.PCX1 * p.LCX
    t48 = t37 * fz
    t49 = p.PEX2 * t8
    t50 = p.PEX1 + t49
    t51 = p.PEX3 * t8
    t52 = t51 * t8
    t53 = t50 + t52
    t54 = t41 > 0.0
    t55 = t41 < 0.0
    t56 = select(t55, -1.0, 0.0)
    t57 = select(t54, 1.0, t56)
    t58 = p.PEX4 * t57
    t59 = 1.0 - t58
    t60 = t53 * t59
    t61 = t60 * p.LEX
    t62 = t47 * t48
    t63 = t62 == 0.0
    t64 = select(t63, 1.0, t62)
    t65 = t24 / t64
    t66 = select(t63, 0.0, t65)
    t67 = minimum(t61, 1.0)
    t68 = t66 * t41
    t69 = maximum(t68, -1e+150)
    t70 = minimum(t69, 1e+150)
    t71 = 1.0 - t67
    t72 = t71 * t70
    t73 = arctan(t70)
    t74 = t67 * t73
    t75 = t72 + t74
    t76 = arctan(t75)
    t77 = t47 * t76
    t78 = sin(t77)
    t79 = t48 * t78
    t80 = t79 + t46
    t81 = p.RBX3 * gamma
    t82 = t81 * gamma
    t83 = p.RBX1 + t82
    t84 = p.RBX2 * kappa
    t85 = t84 * t84
    t86 = 1.0 + t85
    t87 = sqrt(t86)
    t88 = 1.0 / t87
    t89 = t83 * t88
    t90 = t89 * p.LXAL
    t91 = p.REX2 * t8
    t92 = p.REX1 + t91
    t93 = minimum(t92, 1.0)
    t94 = alpha + p.RHX1
    t95 = t90 * t94
    t96 = maximum(t95, -1e+150)
    t97 = minimum(t96, 1e+150)
    t98 = 1.0 - t93
    t99 = t98 * t97
    t100 = arctan(t97)
    t101 = t93 * t100
    t102 = t99 + t101
    t103 = arctan(t102)
    t104 = p.RCX1 * t103
    t105 = cos(t104)
    t106 = t90 * p.RHX1
    t107 = maximum(t106, -1e+150)
    t108 = minimum(t107, 1e+150)
    t109 = t98 * t108
    t110 = arctan(t108)
    t111 = t93 * t110
    t112 = t109 + t111
    t113 = arctan(t112)
    t114 = p.RCX1 * t113
    t115 = cos(t114)
    t116 = t115 == 0.0
    t117 = select(t116, 1.0, t115)
    t118 = t105 / t117
    t119 = select(t116, 0.0, t118)
    t120 = t80 * t119
    t121 = speed / p.LONGVL
    t122 = t121 * t121
    t123 = p.QSY2 * t120
    t124 = t123 / p.FNOMIN
    t125 = p.QSY1 + t124
    t126 = absolute(t121)
    t127 = p.QSY3 * t126
    t128 = t125 + t127
    t129 = p.QSY4 * t122
    t130 = t129 * t122
    t131 = t128 + t130
    t132 = p.QSY6 * t2
    t133 = p.QSY5 + t132
    t134 = t133 * gamma
    t135 = t134 * gamma
    t136 = t131 + t135
    t137 = -p.UNLOADED_RADIUS
    t138 = t137 * p.FNOMIN
    t139 = t138 * t136
    t140 = t139 * t5
    t141 = speed > 0.0
    t142 = select(t9, -1.0, 0.0)
    t143 = select(t141, 1.0, t142)
    t144 = sin(t114)
    t145 = t112 * t112
    t146 = 1.0 + t145
    t147 = t108 * t108
    t148 = 1.0 + t147
    t149 = t107 < 1e+150
    t150 = t106 > -1e+150
    t151 = sin(t104)
    t152 = t102 * t102
    t153 = 1.0 + t152
    t154 = t97 * t97
    t155 = 1.0 + t154
    t156 = t96 < 1e+150
    t157 = t95 > -1e+150
    t158 = t92 < 1.0
    t159 = t87 == 0.0
    t160 = cos(t77)
    t161 = t75 * t75
    t162 = 1.0 + t161
    t163 = t70 * t70
    t164 = 1.0 + t163
    t165 = t69 < 1e+150
    t166 = t68 > -1e+150
    t167 = t61 < 1.0
    t168 = t14 < 100.0
    t169 = t13 > -700.0
    t170 = t143 * p.LMY
    t171 = t143 * t140
    t172 = t170 * t5
    t173 = t170 * t139
    t174 = t172 * t136
    t175 = t172 * t138
    t176 = t174 * p.FNOMIN
    t177 = t174 * t137
    t178 = -t176
    t179 = t175 * gamma
    t180 = t179 * gamma
    t181 = t180 * t2
    t182 = t180 * p.QSY6
    t183 = t175 * t122
    t184 = t175 * t129
    t185 = t183 * t122
    t186 = t183 * p.QSY4
    t187 = t184 + t186
    t188 = t175 * t126
    t189 = t175 * p.QSY3
    t190 = t121 < 0.0
    t191 = -t189
    t192 = select(t190, t191, t189)
    t193 = t175 / p.FNOMIN
    t194 = t193 * t124
    t195 = -t194
    t196 = t177 + t195
    t197 = t193 * t120
    t198 = t193 * p.QSY2
    t199 = t187 * t121
    t200 = t192 + t199
    t201 = t200 + t199
    t202 = t201 / p.LONGVL
    t203 = t202 * t121
    t204 = -t203
    t205 = t198 * t119
    t206 = t198 * t80
    t207 = select(t116, 0.0, t206)
    t208 = t207 / t117
    t209 = t208 * t118
    t210 = -t209
    t211 = select(t116, 0.0, t210)
    t212 = t211 * t144
    t213 = -t212
    t214 = t213 * t113
    t215 = t213 * p.RCX1
    t216 = t215 / t146
    t217 = t216 * t110
    t218 = t216 * t93
    t219 = t218 / t148
    t220 = t216 * t108
    t221 = t216 * t98
    t222 = t219 + t221
    t223 = select(t149, t222, 0.0)
    t224 = select(t150, t223, 0.0)
    t225 = t224 * p.RHX1
    t226 = t224 * t90
    t227 = t208 * t151
    t228 = -t227
    t229 = t228 * t103
    t230 = t228 * p.RCX1
    t231 = t214 + t229
    t232 = t230 / t153
    t233 = t232 * t100
    t234 = t232 * t93
    t235 = t217 + t233
    t236 = t234 / t155
    t237 = t232 * t97
    t238 = t232 * t98
    t239 = t220 + t237
    t240 = t236 + t238
    t241 = -t239
    t242 = t235 + t241
    t243 = select(t156, t240, 0.0)
    t244 = select(t157, t243, 0.0)
    t245 = t244 * t94
    t246 = t244 * t90
    t247 = t225 + t245
    t248 = t226 + t246
    t249 = select(t158, t242, 0.0)
    t250 = t249 * t8
    t251 = t249 * p.REX2
    t252 = t247 * p.LXAL
    t253 = t247 * t89
    t254 = t252 * t88
    t255 = t252 * t83
    t256 = t255 / t87
    t257 = t256 * t88
    t258 = -t257
    t259 = 0.5 * t258
    t260 = t259 / t87
    t261 = select(t159, 0.0, t260)
    t262 = t261 * t84
    t263 = t262 + t262
    t264 = t263 * kappa
    t265 = t254 * gamma
    t266 = t265 * gamma
    t267 = t205 * t78
    t268 = t205 * t48
    t269 = t268 * t160
    t270 = t269 * t76
    t271 = t269 * t47
    t272 = t271 / t162
    t273 = t272 * t73
    t274 = t272 * t67
    t275 = t274 / t164
    t276 = t272 * t70
    t277 = t272 * t71
    t278 = t275 + t277
    t279 = -t276
    t280 = t273 + t279
    t281 = select(t165, t278, 0.0)
    t282 = select(t166, t281, 0.0)
    t283 = t282 * t41
    t284 = t282 * t66
    t285 = select(t167, t280, 0.0)
    t286 = select(t63, 0.0, t283)
    t287 = t286 / t64
    t288 = t287 * t65
    t289 = -t288
    t290 = select(t63, 0.0, t289)
    t291 = t290 * t48
    t292 = t290 * t47
    t293 = t270 + t291
    t294 = t267 + t292
    t295 = t285 * p.LEX
    t296 = t285 * t60
    t297 = t295 * t59
    t298 = t295 * t53
    t299 = -t298
    t300 = t299 * t57
    t301 = t297 * t8
    t302 = t297 * t51
    t303 = t251 + t302
    t304 = t301 * t8
    t305 = t301 * p.PEX3
    t306 = t303 + t305
    t307 = t297 * p.PEX2
    t308 = t306 + t307
    t309 = t294 * fz
    t310 = t293 * p.LCX
    t311 = t293 * p.PCX1
    t312 = t205 * p.LMUX
    t313 = t205 * t45
    t314 = t312 * p.LVX
    t315 = t312 * t44
    t316 = t314 * fz
    t317 = t316 * t8
    t318 = t316 * p.PVX2
    t319 = t308 + t318
    t320 = t284 * p.LHX
    t321 = t284 * t39
    t322 = t320 * t8
    t323 = t320 * p.PHX2
    t324 = t319 + t323
    t325 = t309 * p.LMUX
    t326 = t309 * t36
    t327 = t313 + t326
    t328 = t325 * t35
    t329 = t325 * t32
    t330 = -t329
    t331 = t330 * gamma
    t332 = t331 * gamma
    t333 = t328 * t31
    t334 = t328 * t26
    t335 = t334 * dpi
    t336 = t335 * dpi
    t337 = t333 * t8
    t338 = t333 * p.PDX2
    t339 = t324 + t338
    t340 = t287 * p.LKX
    t341 = t287 * t23
    t342 = t340 * t22
    t343 = t340 * t17
    t344 = t343 * dpi
    t345 = t344 * dpi
    t346 = t342 * t16
    t347 = t342 * t12
    t348 = t347 * t16
    t349 = select(t168, t348, 0.0)
    t350 = select(t169, t349, 0.0)
    t351 = t350 * t8
    t352 = t350 * p.PKX3
    t353 = t339 + t352
    t354 = t346 * fz
    t355 = t354 * t8
    t356 = t354 * p.PKX2
    t357 = t353 + t356
    t358 = t357 / t6
    t359 = t358 * t8
    t360 = -t359
    t361 = -t358
    t362 = t360 + t361
    t363 = t362 * p.LFZO
    t364 = t362 * p.FNOMIN
    t365 = t196 + t363
    t366 = t173 * t4
    t367 = t173 * t3
    t368 = log(t1)
    t369 = t4 * t368
    t370 = t367 * t369
    t371 = log(t2)
    t372 = t3 / t2
    t373 = p.QSY7 * t372
    t374 = t366 * t373
    t375 = t3 * t371
    t376 = t366 * t375
    t377 = t182 + t374
    t378 = t377 / p.FNOMIN
    t379 = t378 * t2
    t380 = -t379
    t381 = t365 + t380
    return (
        t381,
        t178,
        t204,
        t364,
        t311,
        t327,
        t296,
        t341,
        t321,
        t315,
        t253,
        t171,
        t310,
        t333,
        t337,
        t332,
        t297,
        t301,
        t304,
        t300,
        t354,
        t355,
        t351,
        t320,
        t322,
        t316,
        t317,
        t254,
        t264,
        t231,
        t249,
        t250,
        t248,
        t175,
        t197,
        t188,
        t185,
        t344,
        t345,
        t335,
        t336,
        t266,
        t180,
        t181,
        t376,
        t370,
    )


def loop_my(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of my; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(52 * BLOCK)
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
            w[44 * BLOCK + i] = g[38]
            w[45 * BLOCK + i] = g[39]
            w[46 * BLOCK + i] = g[40]
            w[47 * BLOCK + i] = g[41]
            w[48 * BLOCK + i] = g[42]
            w[49 * BLOCK + i] = g[43]
            w[50 * BLOCK + i] = g[44]
            w[51 * BLOCK + i] = g[45]
        for k in range(46):
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
    t3 = speed < 0.0
    t4 = select(t3, -1.0, 1.0)
    t5 = p.PKX2 * t2
    t6 = p.PKX1 + t5
    t7 = fz * t6
    t8 = p.PKX3 * t2
    t9 = maximum(t8, -700.0)
    t10 = minimum(t9, 100.0)
    t11 = exp(t10)
    t12 = t7 * t11
    t13 = p.PPX1 * dpi
    t14 = 1.0 + t13
    t15 = p.PPX2 * dpi
    t16 = t15 * dpi
    t17 = t14 + t16
    t18 = t12 * t17
    t19 = t18 * p.LKX
    t20 = p.PDX2 * t2
    t21 = p.PDX1 + t20
    t22 = p.PPX3 * dpi
    t23 = 1.0 + t22
    t24 = p.PPX4 * dpi
    t25 = t24 * dpi
    t26 = t23 + t25
    t27 = t21 * t26
    t28 = p.PDX3 * gamma
    t29 = t28 * gamma
    t30 = 1.0 - t29
    t31 = t27 * t30
    t32 = t31 * p.LMUX
    t33 = p.PHX2 * t2
    t34 = p.PHX1 + t33
    t35 = t34 * p.LHX
    t36 = kappa + t35
    t37 = p.PVX2 * t2
    t38 = p.PVX1 + t37
    t39 = fz * t38
    t40 = t39 * p.LVX
    t41 = t40 * p.LMUX
    t42 = p.PCX1 * p.LCX
    t43 = t32 * fz
    t44 = p.PEX2 * t2
    t45 = p.PEX1 + t44
    t46 = p.PEX3 * t2
    t47 = t46 * t2
    t48 = t45 + t47
    t49 = t36 > 0.0
    t50 = t36 < 0.0
    t51 = select(t50, -1.0, 0.0)
    t52 = select(t49, 1.0, t51)
    t53 = p.PEX4 * t52
    t54 = 1.0 - t53
    t55 = t48 * t54
    t56 = t55 * p.LEX
    t57 = t42 * t43
    t58 = t57 == 0.0
    t59 = select(t58, 1.0, t57)
    t60 = t19 / t59
    t61 = select(t58, 0.0, t60)
    t62 = minimum(t56, 1.0)
    t63 = t61 * t36
    t64 = maximum(t63, -1e+150)
    t65 = minimum(t64, 1e+150)
    t66 = 1.0 - t62
    t67 = t66 * t65
    t68 = arctan(t65)
    t69 = t62 * t68
    t70 = t67 + t69
    t71 = arctan(t70)
    t72 = t42 * t71
    t73 = sin(t72)
    t74 = t43 * t73
    t75 = t74 + t41
    t76 = fz / t0
    t77 = p.PKY5 * gamma
    t78 = t77 * gamma
    t79 = p.PKY2 + t78
    t80 = p.PPY2 * dpi
    t81 = 1.0 + t80
    t82 = t79 * t81
    t83 = t82 == 0.0
    t84 = select(t83, 1.0, t82)
    t85 = t76 / t84
    t86 = select(t83, 0.0, t85)
    t87 = p.PKY1 * t0
    t88 = p.PPY1 * dpi
    t89 = 1.0 + t88
    t90 = t87 * t89
    t91 = absolute(gamma)
    t92 = p.PKY3 * t91
    t93 = 1.0 - t92
    t94 = t90 * t93
    t95 = arctan(t86)
    t96 = p.PKY4 * t95
    t97 = sin(t96)
    t98 = t94 * t97
    t99 = t98 * p.LKY
    t100 = p.PVY4 * t2
    t101 = p.PVY3 + t100
    t102 = fz * t101
    t103 = t102 * gamma
    t104 = t103 * p.LKYC
    t105 = t104 * p.LMUY
    t106 = p.PDY2 * t2
    t107 = p.PDY1 + t106
    t108 = p.PPY3 * dpi
    t109 = 1.0 + t108
    t110 = p.PPY4 * dpi
    t111 = t110 * dpi
    t112 = t109 + t111
    t113 = t107 * t112
    t114 = p.PDY3 * gamma
    t115 = t114 * gamma
    t116 = 1.0 - t115
    t117 = t113 * t116
    t118 = t117 * p.LMUY
    t119 = p.PKY7 * t2
    t120 = p.PKY6 + t119
    t121 = fz * t120
    t122 = p.PPY5 * dpi
    t123 = 1.0 + t122
    t124 = t121 * t123
    t125 = t124 * p.LKYC
    t126 = t125 * gamma
    t127 = t126 - t105
    t128 = t99 == 0.0
    t129 = select(t128, 1.0, t99)
    t130 = t127 / t129
    t131 = select(t128, 0.0, t130)
    t132 = p.PHY2 * t2
    t133 = p.PHY1 + t132
    t134 = t133 * p.LHY
    t135 = t134 + t131
    t136 = t135 + 1.0
    t137 = t136 - 1.0
    t138 = p.PVY2 * t2
    t139 = p.PVY1 + t138
    t140 = fz * t139
    t141 = t140 * p.LVY
    t142 = t141 * p.LMUY
    t143 = t142 + t105
    t144 = alpha + t137
    t145 = p.PCY1 * p.LCY
    t146 = t118 * fz
    t147 = p.PEY2 * t2
    t148 = p.PEY1 + t147
    t149 = p.PEY5 * gamma
    t150 = t149 * gamma
    t151 = 1.0 + t150
    t152 = p.PEY4 * gamma
    t153 = p.PEY3 + t152
    t154 = t144 > 0.0
    t155 = t144 < 0.0
    t156 = select(t155, -1.0, 0.0)
    t157 = select(t154, 1.0, t156)
    t158 = t153 * t157
    t159 = t151 - t158
    t160 = t148 * t159
    t161 = t160 * p.LEY
    t162 = t145 * t146
    t163 = t162 == 0.0
    t164 = select(t163, 1.0, t162)
    t165 = t99 / t164
    t166 = select(t163, 0.0, t165)
    t167 = minimum(t161, 1.0)
    t168 = t166 * t144
    t169 = maximum(t168, -1e+150)
    t170 = minimum(t169, 1e+150)
    t171 = 1.0 - t167
    t172 = t171 * t170
    t173 = arctan(t170)
    t174 = t167 * t173
    t175 = t172 + t174
    t176 = arctan(t175)
    t177 = t145 * t176
    t178 = sin(t177)
    t179 = t146 * t178
    t180 = t179 + t143
    t181 = t166 * t145
    t182 = p.RBX3 * gamma
    t183 = t182 * gamma
    t184 = p.RBX1 + t183
    t185 = p.RBX2 * kappa
    t186 = t185 * t185
    t187 = 1.0 + t186
    t188 = sqrt(t187)
    t189 = 1.0 / t188
    t190 = t184 * t189
    t191 = t190 * p.LXAL
    t192 = p.REX2 * t2
    t193 = p.REX1 + t192
    t194 = minimum(t193, 1.0)
    t195 = alpha + p.RHX1
    t196 = t191 * t195
    t197 = maximum(t196, -1e+150)
    t198 = minimum(t197, 1e+150)
    t199 = 1.0 - t194
    t200 = t199 * t198
    t201 = arctan(t198)
    t202 = t194 * t201
    t203 = t200 + t202
    t204 = arctan(t203)
    t205 = p.RCX1 * t204
    t206 = cos(t205)
    t207 = t191 * p.RHX1
    t208 = maximum(t207, -1e+150)
    t209 = minimum(t208, 1e+150)
    t210 = t199 * t209
    t211 = arctan(t209)
    t212 = t194 * t211
    t213 = t210 + t212
    t214 = arctan(t213)
    t215 = p.RCX1 * t214
    t216 = cos(t215)
    t217 = t216 == 0.0
    t218 = select(t217, 1.0, t216)
    t219 = t206 / t218
    t220 = select(t217, 0.0, t219)
    t221 = t75 * t220
    t222 = p.RBY4 * gamma
    t223 = t222 * gamma
    t224 = p.RBY1 + t223
    t225 = alpha - p.RBY3
    t226 = p.RBY2 * t225
    t227 = t226 * t226
    t228 = 1.0 + t227
    t229 = sqrt(t228)
    t230 = 1.0 / t229
    t231 = t224 * t230
    t232 = t231 * p.LYKA
    t233 = p.REY2 * t2
    t234 = p.REY1 + t233
    t235 = minimum(t234, 1.0)
    t236 = p.RHY2 * t2
    t237 = p.RHY1 + t236
    t238 = kappa + t237
    t239 = t232 * t238
    t240 = maximum(t239, -1e+150)
    t241 = minimum(t240, 1e+150)
    t242 = 1.0 - t235
    t243 = t242 * t241
    t244 = arctan(t241)
    t245 = t235 * t244
    t246 = t243 + t245
    t247 = arctan(t246)
    t248 = p.RCY1 * t247
    t249 = cos(t248)
    t250 = t232 * t237
    t251 = maximum(t250, -1e+150)
    t252 = minimum(t251, 1e+150)
    t253 = t242 * t252
    t254 = arctan(t252)
    t255 = t235 * t254
    t256 = t253 + t255
    t257 = arctan(t256)
    t258 = p.RCY1 * t257
    t259 = cos(t258)
    t260 = t259 == 0.0
    t261 = select(t260, 1.0, t259)
    t262 = t249 / t261
    t263 = select(t260, 0.0, t262)
    t264 = t180 * t263
    t265 = p.RVY2 * t2
    t266 = p.RVY1 + t265
    t267 = p.RVY3 * gamma
    t268 = t266 + t267
    t269 = t146 * t268
    t270 = p.RVY4 * alpha
    t271 = t270 * t270
    t272 = 1.0 + t271
    t273 = sqrt(t272)
    t274 = 1.0 / t273
    t275 = t269 * t274
    t276 = p.RVY6 * kappa
    t277 = arctan(t276)
    t278 = p.RVY5 * t277
    t279 = sin(t278)
    t280 = t275 * t279
    t281 = t280 * p.LVYKA
    t282 = t264 + t281
    t283 = t19 / t129
    t284 = select(t128, 0.0, t283)
    t285 = alpha + p.QHZ1
    t286 = p.QHZ2 * t2
    t287 = t285 + t286
    t288 = p.QHZ4 * t2
    t289 = p.QHZ3 + t288
    t290 = t289 * gamma
    t291 = t287 + t290
    t292 = p.QBZ2 * t2
    t293 = p.QBZ1 + t292
    t294 = p.QBZ3 * t2
    t295 = t294 * t2
    t296 = t293 + t295
    t297 = p.QBZ4 * gamma
    t298 = 1.0 + t297
    t299 = p.QBZ5 * t91
    t300 = t298 + t299
    t301 = t296 * t300
    t302 = t301 * p.LKY
    t303 = t302 / p.LMUY
    t304 = p.UNLOADED_RADIUS / p.FNOMIN
    t305 = fz * t304
    t306 = p.QDZ2 * t2
    t307 = p.QDZ1 + t306
    t308 = t305 * t307
    t309 = p.PPZ1 * dpi
    t310 = 1.0 - t309
    t311 = t308 * t310
    t312 = p.QDZ3 * gamma
    t313 = 1.0 + t312
    t314 = p.QDZ4 * gamma
    t315 = t314 * gamma
    t316 = t313 + t315
    t317 = t311 * t316
    t318 = t317 * p.LTR
    t319 = t318 * t4
    t320 = p.QEZ2 * t2
    t321 = p.QEZ1 + t320
    t322 = p.QEZ3 * t2
    t323 = t322 * t2
    t324 = t321 + t323
    t325 = p.QEZ5 * gamma
    t326 = p.QEZ4 + t325
    t327 = t326 * 0.6366197723675814
    t328 = t303 * p.QCZ1
    t329 = t328 * t291
    t330 = arctan(t329)
    t331 = t327 * t330
    t332 = 1.0 + t331
    t333 = t324 * t332
    t334 = sin(t291)
    t335 = cos(t291)
    t336 = t335 == 0.0
    t337 = select(t336, 1.0, t335)
    t338 = t334 / t337
    t339 = select(t336, 0.0, t338)
    t340 = maximum(t284, -1e+150)
    t341 = minimum(t340, 1e+150)
    t342 = t341 * kappa
    t343 = t339 * t339
    t344 = t342 * t342
    t345 = minimum(t344, 9.999999999999999e+299)
    t346 = t343 + t345
    t347 = sqrt(t346)
    t348 = arctan(t347)
    t349 = t291 > 0.0
    t350 = t291 < 0.0
    t351 = select(t350, -1.0, 0.0)
    t352 = select(t349, 1.0, t351)
    t353 = t348 * t352
    t354 = minimum(t333, 1.0)
    t355 = t303 * t353
    t356 = maximum(t355, -1e+150)
    t357 = minimum(t356, 1e+150)
    t358 = 1.0 - t354
    t359 = t358 * t357
    t360 = arctan(t357)
    t361 = t354 * t360
    t362 = t359 + t361
    t363 = arctan(t362)
    t364 = p.QCZ1 * t363
    t365 = cos(t364)
    t366 = t319 * t365
    t367 = cos(alpha)
    t368 = t366 * t367
    t369 = t143 / t129
    t370 = select(t128, 0.0, t369)
    t371 = t144 + t370
    t372 = p.QBZ9 * p.LKY
    t373 = t372 / p.LMUY
    t374 = p.QBZ10 * t181
    t375 = t373 + t374
    t376 = p.QDZ9 * t2
    t377 = p.QDZ8 + t376
    t378 = p.PPZ2 * dpi
    t379 = 1.0 + t378
    t380 = t377 * t379
    t381 = p.QDZ11 * t2
    t382 = p.QDZ10 + t381
    t383 = t382 * t91
    t384 = t380 + t383
    t385 = fz * p.UNLOADED_RADIUS
    t386 = p.QDZ7 * t2
    t387 = p.QDZ6 + t386
    t388 = t387 * p.LRES
    t389 = t384 * gamma
    t390 = t389 * p.LKZC
    t391 = t388 + t390
    t392 = t385 * t391
    t393 = t392 * p.LMUY
    t394 = t393 * t4
    t395 = t394 + 1.0
    t396 = t395 - 1.0
    t397 = sin(t371)
    t398 = cos(t371)
    t399 = t398 == 0.0
    t400 = select(t399, 1.0, t398)
    t401 = t397 / t400
    t402 = select(t399, 0.0, t401)
    t403 = t402 * t402
    t404 = t403 + t345
    t405 = sqrt(t404)
    t406 = arctan(t405)
    t407 = t371 > 0.0
    t408 = t371 < 0.0
    t409 = select(t408, -1.0, 0.0)
    t410 = select(t407, 1.0, t409)
    t411 = t406 * t410
    t412 = t375 * t411
    t413 = arctan(t412)
    t414 = cos(t413)
    t415 = p.PKY2 * t81
    t416 = t415 == 0.0
    t417 = select(t416, 1.0, t415)
    t418 = t76 / t417
    t419 = select(t416, 0.0, t418)
    t420 = arctan(t419)
    t421 = p.PKY4 * t420
    t422 = sin(t421)
    t423 = t90 * t422
    t424 = t423 * p.LKY
    t425 = t113 * p.LMUY
    t426 = t424 == 0.0
    t427 = select(t426, 0.0, 0.0)
    t428 = t134 + t427
    t429 = t428 + 1.0
    t430 = t429 - 1.0
    t431 = alpha + t430
    t432 = t425 * fz
    t433 = t431 > 0.0
    t434 = t431 < 0.0
    t435 = select(t434, -1.0, 0.0)
    t436 = select(t433, 1.0, t435)
    t437 = p.PEY3 * t436
    t438 = 1.0 - t437
    t439 = t148 * t438
    t440 = t439 * p.LEY
    t441 = t145 * t432
    t442 = t441 == 0.0
    t443 = select(t442, 1.0, t441)
    t444 = t424 / t443
    t445 = select(t442, 0.0, t444)
    t446 = minimum(t440, 1.0)
    t447 = t445 * t431
    t448 = maximum(t447, -1e+150)
    t449 = minimum(t448, 1e+150)
    t450 = 1.0 - t446
    t451 = t450 * t449
    t452 = arctan(t449)
    t453 = t446 * t452
    t454 = t451 + t453
    t455 = arctan(t454)
    t456 = t145 * t455
    t457 = sin(t456)
    t458 = t432 * t457
    t459 = t458 + t142
    t460 = p.SSZ2 * t282
    t461 = t460 / p.FNOMIN
    t462 = p.SSZ1 + t461
    t463 = p.SSZ4 * t2
    t464 = p.SSZ3 + t463
    t465 = t464 * gamma
    t466 = t462 + t465
    t467 = t466 * p.UNLOADED_RADIUS
    t468 = t467 * p.LS
    t469 = t263 * t459
    t470 = -t368
    t471 = sin(t215)
    t472 = t213 * t213
    t473 = 1.0 + t472
    t474 = t209 * t209
    t475 = 1.0 + t474
    t476 = t208 < 1e+150
    t477 = t207 > -1e+150
    t478 = sin(t205)
    t479 = t203 * t203
    t480 = 1.0 + t479
    t481 = t198 * t198
    t482 = 1.0 + t481
    t483 = t197 < 1e+150
    t484 = t196 > -1e+150
    t485 = t193 < 1.0
    t486 = t188 == 0.0
    t487 = cos(t72)
    t488 = t70 * t70
    t489 = 1.0 + t488
    t490 = t65 * t65
    t491 = 1.0 + t490
    t492 = t64 < 1e+150
    t493 = t63 > -1e+150
    t494 = t56 < 1.0
    t495 = t9 < 100.0
    t496 = t8 > -700.0
    t497 = cos(t278)
    t498 = t276 * t276
    t499 = 1.0 + t498
    t500 = t273 == 0.0
    t501 = sin(t258)
    t502 = t256 * t256
    t503 = 1.0 + t502
    t504 = t252 * t252
    t505 = 1.0 + t504
    t506 = t251 < 1e+150
    t507 = t250 > -1e+150
    t508 = sin(t248)
    t509 = t246 * t246
    t510 = 1.0 + t509
    t511 = t241 * t241
    t512 = 1.0 + t511
    t513 = t240 < 1e+150
    t514 = t239 > -1e+150
    t515 = t234 < 1.0
    t516 = t229 == 0.0
    t517 = cos(t177)
    t518 = t175 * t175
    t519 = 1.0 + t518
    t520 = t170 * t170
    t521 = 1.0 + t520
    t522 = t169 < 1e+150
    t523 = t168 > -1e+150
    t524 = t161 < 1.0
    t525 = cos(t96)
    t526 = t86 * t86
    t527 = 1.0 + t526
    t528 = -t469
    t529 = t470 * t459
    t530 = t470 * t263
    t531 = t221 * p.LS
    t532 = t221 * t467
    t533 = t531 * p.UNLOADED_RADIUS
    t534 = t531 * t466
    t535 = t533 * gamma
    t536 = t535 * t2
    t537 = t535 * p.SSZ4
    t538 = t533 / p.FNOMIN
    t539 = t538 * t461
    t540 = -t539
    t541 = t538 * t282
    t542 = t538 * p.SSZ2
    t543 = t530 * t457
    t544 = t530 * t432
    t545 = cos(t456)
    t546 = t544 * t545
    t547 = t546 * t455
    t548 = t546 * t145
    t549 = t454 * t454
    t550 = 1.0 + t549
    t551 = t548 / t550
    t552 = t551 * t452
    t553 = t551 * t446
    t554 = t449 * t449
    t555 = 1.0 + t554
    t556 = t553 / t555
    t557 = t551 * t449
    t558 = t551 * t450
    t559 = t556 + t558
    t560 = -t557
    t561 = t552 + t560
    t562 = t448 < 1e+150
    t563 = select(t562, t559, 0.0)
    t564 = t447 > -1e+150
    t565 = select(t564, t563, 0.0)
    t566 = t565 * t431
    t567 = t565 * t445
    t568 = t440 < 1.0
    t569 = select(t568, t561, 0.0)
    t570 = select(t442, 0.0, t566)
    t571 = t570 / t443
    t572 = t571 * t444
    t573 = -t572
    t574 = select(t442, 0.0, t573)
    t575 = t574 * t432
    t576 = t574 * t145
    t577 = t547 + t575
    t578 = t543 + t576
    t579 = t569 * p.LEY
    t580 = t569 * t439
    t581 = t579 * t438
    t582 = t579 * t148
    t583 = -t582
    t584 = t583 * t436
    t585 = t578 * fz
    t586 = t585 * p.LMUY
    t587 = t585 * t113
    t588 = t571 * p.LKY
    t589 = t571 * t423
    t590 = t588 * t422
    t591 = t588 * t90
    t592 = cos(t421)
    t593 = t591 * t592
    t594 = t593 * t420
    t595 = t593 * p.PKY4
    t596 = t419 * t419
    t597 = 1.0 + t596
    t598 = t595 / t597
    t599 = select(t416, 0.0, t598)
    t600 = t599 / t417
    t601 = t600 * t418
    t602 = -t601
    t603 = select(t416, 0.0, t602)
    t604 = t603 * t81
    t605 = t603 * p.PKY2
    t606 = t367 * t414
    t607 = t367 * t396
    t608 = sin(t413)
    t609 = t607 * t608
    t610 = -t609
    t611 = t412 * t412
    t612 = 1.0 + t611
    t613 = t610 / t612
    t614 = t613 * t411
    t615 = t613 * t375
    t616 = t615 * t410
    t617 = t405 * t405
    t618 = 1.0 + t617
    t619 = t616 / t618
    t620 = t405 == 0.0
    t621 = 0.5 * t619
    t622 = t621 / t405
    t623 = select(t620, 0.0, t622)
    t624 = t623 * t402
    t625 = t624 + t624
    t626 = select(t399, 0.0, t625)
    t627 = t626 / t400
    t628 = t627 * t401
    t629 = -t628
    t630 = select(t399, 0.0, t629)
    t631 = t630 * t397
    t632 = -t631
    t633 = t627 * t398
    t634 = t632 + t633
    t635 = t606 * t4
    t636 = t635 * p.LMUY
    t637 = t635 * t392
    t638 = t587 + t637
    t639 = t636 * t391
    t640 = t636 * t385
    t641 = t640 * p.LKZC
    t642 = t640 * t389
    t643 = t641 * gamma
    t644 = t640 * p.LRES
    t645 = t640 * t387
    t646 = t644 * t2
    t647 = t644 * p.QDZ7
    t648 = t537 + t647
    t649 = t639 * fz
    t650 = t534 + t649
    t651 = t643 * t91
    t652 = t651 * t2
    t653 = t651 * p.QDZ11
    t654 = t648 + t653
    t655 = t643 * t379
    t656 = t643 * t377
    t657 = t656 * dpi
    t658 = t655 * t2
    t659 = t655 * p.QDZ9
    t660 = t654 + t659
    t661 = t614 * t181
    t662 = t614 * p.QBZ10
    t663 = t614 / p.LMUY
    t664 = t663 * t373
    t665 = -t664
    t666 = t638 + t665
    t667 = t663 * p.LKY
    t668 = t663 * p.QBZ9
    t669 = t589 + t668
    t670 = select(t128, 0.0, t634)
    t671 = t670 / t129
    t672 = t671 * t369
    t673 = -t672
    t674 = t528 * t367
    t675 = t674 * t365
    t676 = t674 * t319
    t677 = sin(t364)
    t678 = t676 * t677
    t679 = -t678
    t680 = t679 * t363
    t681 = t679 * p.QCZ1
    t682 = t362 * t362
    t683 = 1.0 + t682
    t684 = t681 / t683
    t685 = t684 * t360
    t686 = t684 * t354
    t687 = t357 * t357
    t688 = 1.0 + t687
    t689 = t686 / t688
    t690 = t684 * t357
    t691 = t684 * t358
    t692 = t689 + t691
    t693 = -t690
    t694 = t685 + t693
    t695 = t356 < 1e+150
    t696 = select(t695, t692, 0.0)
    t697 = t355 > -1e+150
    t698 = select(t697, t696, 0.0)
    t699 = t698 * t353
    t700 = t698 * t303
    t701 = t333 < 1.0
    t702 = select(t701, t694, 0.0)
    t703 = t700 * t352
    t704 = t347 * t347
    t705 = 1.0 + t704
    t706 = t703 / t705
    t707 = t347 == 0.0
    t708 = 0.5 * t706
    t709 = t708 / t347
    t710 = select(t707, 0.0, t709)
    t711 = t623 + t710
    t712 = t344 < 9.999999999999999e+299
    t713 = select(t712, t711, 0.0)
    t714 = t713 * t342
    t715 = t714 + t714
    t716 = t710 * t339
    t717 = t716 + t716
    t718 = t715 * kappa
    t719 = t340 < 1e+150
    t720 = select(t719, t718, 0.0)
    t721 = t284 > -1e+150
    t722 = select(t721, t720, 0.0)
    t723 = select(t336, 0.0, t717)
    t724 = t723 / t337
    t725 = t724 * t338
    t726 = -t725
    t727 = select(t336, 0.0, t726)
    t728 = t727 * t334
    t729 = -t728
    t730 = t724 * t335
    t731 = t729 + t730
    t732 = t702 * t332
    t733 = t702 * t324
    t734 = t733 * t330
    t735 = t733 * t327
    t736 = t329 * t329
    t737 = 1.0 + t736
    t738 = t735 / t737
    t739 = t738 * t291
    t740 = t738 * t328
    t741 = t731 + t740
    t742 = t739 * p.QCZ1
    t743 = t739 * t303
    t744 = t699 + t742
    t745 = t680 + t743
    t746 = t734 * 0.6366197723675814
    t747 = t746 * gamma
    t748 = t732 * t2
    t749 = t732 * t322
    t750 = t660 + t749
    t751 = t748 * t2
    t752 = t748 * p.QEZ3
    t753 = t750 + t752
    t754 = t732 * p.QEZ2
    t755 = t753 + t754
    t756 = t675 * t4
    t757 = t756 * p.LTR
    t758 = t756 * t317
    t759 = t757 * t316
    t760 = t757 * t311
    t761 = t760 * gamma
    t762 = t761 * gamma
    t763 = t759 * t310
    t764 = t759 * t308
    t765 = -t764
    t766 = t765 * dpi
    t767 = t763 * t307
    t768 = t763 * t305
    t769 = t768 * t2
    t770 = t768 * p.QDZ2
    t771 = t755 + t770
    t772 = t767 * fz
    t773 = t772 / p.FNOMIN
    t774 = t773 * t304
    t775 = -t774
    t776 = t650 + t773
    t777 = t540 + t775
    t778 = t744 / p.LMUY
    t779 = t778 * t303
    t780 = -t779
    t781 = t666 + t780
    t782 = t778 * p.LKY
    t783 = t778 * t301
    t784 = t669 + t783
    t785 = t782 * t300
    t786 = t782 * t296
    t787 = t786 * t91
    t788 = t786 * gamma
    t789 = t785 * t2
    t790 = t785 * t294
    t791 = t771 + t790
    t792 = t789 * t2
    t793 = t789 * p.QBZ3
    t794 = t791 + t793
    t795 = t785 * p.QBZ2
    t796 = t794 + t795
    t797 = t741 * gamma
    t798 = t797 * t2
    t799 = t797 * p.QHZ4
    t800 = t796 + t799
    t801 = t741 * t2
    t802 = t741 * p.QHZ2
    t803 = t800 + t802
    t804 = select(t128, 0.0, t722)
    t805 = t804 / t129
    t806 = t805 * t283
    t807 = -t806
    t808 = t673 + t807
    t809 = t542 * p.LVYKA
    t810 = t542 * t280
    t811 = t809 * t279
    t812 = t809 * t275
    t813 = t812 * t497
    t814 = t813 * t277
    t815 = t813 * p.RVY5
    t816 = t815 / t499
    t817 = t816 * kappa
    t818 = t811 * t274
    t819 = t811 * t269
    t820 = t819 / t273
    t821 = t820 * t274
    t822 = -t821
    t823 = 0.5 * t822
    t824 = t823 / t273
    t825 = select(t500, 0.0, t824)
    t826 = t825 * t270
    t827 = t826 + t826
    t828 = t827 * alpha
    t829 = t818 * t268
    t830 = t818 * t146
    t831 = t830 * gamma
    t832 = t830 * t2
    t833 = t830 * p.RVY2
    t834 = t803 + t833
    t835 = t542 * t263
    t836 = t542 * t180
    t837 = t529 + t836
    t838 = select(t260, 0.0, t837)
    t839 = t838 / t261
    t840 = t839 * t262
    t841 = -t840
    t842 = select(t260, 0.0, t841)
    t843 = t842 * t501
    t844 = -t843
    t845 = t844 * t257
    t846 = t844 * p.RCY1
    t847 = t846 / t503
    t848 = t847 * t254
    t849 = t847 * t235
    t850 = t849 / t505
    t851 = t847 * t252
    t852 = t847 * t242
    t853 = t850 + t852
    t854 = select(t506, t853, 0.0)
    t855 = select(t507, t854, 0.0)
    t856 = t855 * t237
    t857 = t855 * t232
    t858 = t839 * t508
    t859 = -t858
    t860 = t859 * t247
    t861 = t859 * p.RCY1
    t862 = t845 + t860
    t863 = t861 / t510
    t864 = t863 * t244
    t865 = t863 * t235
    t866 = t848 + t864
    t867 = t865 / t512
    t868 = t863 * t241
    t869 = t863 * t242
    t870 = t851 + t868
    t871 = t867 + t869
    t872 = -t870
    t873 = t866 + t872
    t874 = select(t513, t871, 0.0)
    t875 = select(t514, t874, 0.0)
    t876 = t875 * t238
    t877 = t875 * t232
    t878 = t856 + t876
    t879 = t857 + t877
    t880 = t879 * t2
    t881 = t879 * p.RHY2
    t882 = t834 + t881
    t883 = select(t515, t873, 0.0)
    t884 = t883 * t2
    t885 = t883 * p.REY2
    t886 = t882 + t885
    t887 = t878 * p.LYKA
    t888 = t878 * t231
    t889 = t887 * t230
    t890 = t887 * t224
    t891 = t890 / t229
    t892 = t891 * t230
    t893 = -t892
    t894 = 0.5 * t893
    t895 = t894 / t229
    t896 = select(t516, 0.0, t895)
    t897 = t896 * t226
    t898 = t897 + t897
    t899 = t898 * t225
    t900 = t898 * p.RBY2
    t901 = -t900
    t902 = t889 * gamma
    t903 = t902 * gamma
    t904 = t468 * t220
    t905 = t468 * t75
    t906 = select(t217, 0.0, t905)
    t907 = t906 / t218
    t908 = t907 * t219
    t909 = -t908
    t910 = select(t217, 0.0, t909)
    t911 = t910 * t471
    t912 = -t911
    t913 = t912 * t214
    t914 = t912 * p.RCX1
    t915 = t914 / t473
    t916 = t915 * t211
    t917 = t915 * t194
    t918 = t917 / t475
    t919 = t915 * t209
    t920 = t915 * t199
    t921 = t918 + t920
    t922 = select(t476, t921, 0.0)
    t923 = select(t477, t922, 0.0)
    t924 = t923 * p.RHX1
    t925 = t923 * t191
    t926 = t907 * t478
    t927 = -t926
    t928 = t927 * t204
    t929 = t927 * p.RCX1
    t930 = t913 + t928
    t931 = t929 / t480
    t932 = t931 * t201
    t933 = t931 * t194
    t934 = t916 + t932
    t935 = t933 / t482
    t936 = t931 * t198
    t937 = t931 * t199
    t938 = t919 + t936
    t939 = t935 + t937
    t940 = -t938
    t941 = t934 + t940
    t942 = select(t483, t939, 0.0)
    t943 = select(t484, t942, 0.0)
    t944 = t943 * t195
    t945 = t943 * t191
    t946 = t924 + t944
    t947 = t925 + t945
    t948 = select(t485, t941, 0.0)
    t949 = t948 * t2
    t950 = t948 * p.REX2
    t951 = t886 + t950
    t952 = t946 * p.LXAL
    t953 = t946 * t190
    t954 = t952 * t189
    t955 = t952 * t184
    t956 = t955 / t188
    t957 = t956 * t189
    t958 = -t957
    t959 = 0.5 * t958
    t960 = t959 / t188
    t961 = select(t486, 0.0, t960)
    t962 = t961 * t185
    t963 = t962 + t962
    t964 = t963 * kappa
    t965 = t954 * gamma
    t966 = t965 * gamma
    t967 = t662 * t145
    t968 = t662 * t166
    t969 = t577 + t968
    t970 = t671 + t835
    t971 = t835 * t178
    t972 = t835 * t146
    t973 = t829 + t971
    t974 = t972 * t517
    t975 = t974 * t176
    t976 = t974 * t145
    t977 = t969 + t975
    t978 = t976 / t519
    t979 = t978 * t173
    t980 = t978 * t167
    t981 = t980 / t521
    t982 = t978 * t170
    t983 = t978 * t171
    t984 = t981 + t983
    t985 = -t982
    t986 = t979 + t985
    t987 = select(t522, t984, 0.0)
    t988 = select(t523, t987, 0.0)
    t989 = t988 * t144
    t990 = t988 * t166
    t991 = t967 + t989
    t992 = t634 + t990
    t993 = select(t524, t986, 0.0)
    t994 = select(t163, 0.0, t991)
    t995 = t994 / t164
    t996 = t995 * t165
    t997 = -t996
    t998 = select(t163, 0.0, t997)
    t999 = t998 * t146
    t1000 = t998 * t145
    t1001 = t977 + t999
    t1002 = t973 + t1000
    t1003 = t993 * p.LEY
    t1004 = t993 * t160
    t1005 = t580 + t1004
    t1006 = t1003 * t159
    t1007 = t1003 * t148
    t1008 = t581 + t1006
    t1009 = -t1007
    t1010 = t1009 * t157
    t1011 = t584 + t1010
    t1012 = t1010 * gamma
    t1013 = t1007 * gamma
    t1014 = t1013 * gamma
    t1015 = t1008 * t2
    t1016 = t1008 * p.PEY2
    t1017 = t951 + t1016
    t1018 = t1002 * fz
    t1019 = t1001 * p.LCY
    t1020 = t1001 * p.PCY1
    t1021 = t530 + t970
    t1022 = t1021 * p.LMUY
    t1023 = t1021 * t141
    t1024 = t781 + t1023
    t1025 = t1022 * p.LVY
    t1026 = t1022 * t140
    t1027 = t1025 * fz
    t1028 = t1027 * t2
    t1029 = t1027 * p.PVY2
    t1030 = t1017 + t1029
    t1031 = t567 + t992
    t1032 = t1031 * p.LHY
    t1033 = t1031 * t133
    t1034 = t1032 * t2
    t1035 = t1032 * p.PHY2
    t1036 = t1030 + t1035
    t1037 = select(t128, 0.0, t992)
    t1038 = t1037 / t129
    t1039 = t1038 * t130
    t1040 = -t1039
    t1041 = t808 + t1040
    t1042 = select(t128, 0.0, t1041)
    t1043 = t995 + t1042
    t1044 = -t1038
    t1045 = t970 + t1044
    t1046 = t1038 * gamma
    t1047 = t1046 * p.LKYC
    t1048 = t1046 * t124
    t1049 = t1047 * t123
    t1050 = t1047 * t121
    t1051 = t1050 * dpi
    t1052 = t1049 * fz
    t1053 = t1052 * t2
    t1054 = t1052 * p.PKY7
    t1055 = t1036 + t1054
    t1056 = t1018 * p.LMUY
    t1057 = t1018 * t117
    t1058 = t1024 + t1057
    t1059 = t1056 * t116
    t1060 = t1056 * t113
    t1061 = t586 + t1059
    t1062 = -t1060
    t1063 = t1062 * gamma
    t1064 = t1063 * gamma
    t1065 = t1061 * t112
    t1066 = t1061 * t107
    t1067 = t1066 * dpi
    t1068 = t1067 * dpi
    t1069 = t1065 * t2
    t1070 = t1065 * p.PDY2
    t1071 = t1055 + t1070
    t1072 = t1045 * p.LMUY
    t1073 = t1045 * t104
    t1074 = t1058 + t1073
    t1075 = t1072 * p.LKYC
    t1076 = t1072 * t103
    t1077 = t1048 + t1076
    t1078 = t1075 * gamma
    t1079 = t1078 * fz
    t1080 = t1079 * t2
    t1081 = t1079 * p.PVY4
    t1082 = t1071 + t1081
    t1083 = t1043 * p.LKY
    t1084 = t1043 * t98
    t1085 = t784 + t1084
    t1086 = t1083 * t97
    t1087 = t1083 * t94
    t1088 = t1087 * t525
    t1089 = t1088 * t95
    t1090 = t1088 * p.PKY4
    t1091 = t594 + t1089
    t1092 = t1090 / t527
    t1093 = t1086 * t93
    t1094 = t1086 * t90
    t1095 = t590 + t1093
    t1096 = -t1094
    t1097 = t1096 * t91
    t1098 = t1095 * t89
    t1099 = t1095 * t87
    t1100 = t1099 * dpi
    t1101 = t1098 * t0
    t1102 = t1098 * p.PKY1
    t1103 = select(t83, 0.0, t1092)
    t1104 = t1103 / t84
    t1105 = t1104 * t85
    t1106 = -t1105
    t1107 = t600 + t1104
    t1108 = select(t83, 0.0, t1106)
    t1109 = t1108 * t81
    t1110 = t1108 * t79
    t1111 = t605 + t1110
    t1112 = t1111 * dpi
    t1113 = t604 + t1109
    t1114 = t1109 * gamma
    t1115 = t1114 * gamma
    t1116 = t1107 / t0
    t1117 = t1116 * t76
    t1118 = -t1117
    t1119 = t1102 + t1118
    t1120 = t904 * t73
    t1121 = t904 * t43
    t1122 = t1121 * t487
    t1123 = t1122 * t71
    t1124 = t1122 * t42
    t1125 = t1124 / t489
    t1126 = t1125 * t68
    t1127 = t1125 * t62
    t1128 = t1127 / t491
    t1129 = t1125 * t65
    t1130 = t1125 * t66
    t1131 = t1128 + t1130
    t1132 = -t1129
    t1133 = t1126 + t1132
    t1134 = select(t492, t1131, 0.0)
    t1135 = select(t493, t1134, 0.0)
    t1136 = t1135 * t36
    t1137 = t1135 * t61
    t1138 = select(t494, t1133, 0.0)
    t1139 = select(t58, 0.0, t1136)
    t1140 = t1139 / t59
    t1141 = t1140 * t60
    t1142 = -t1141
    t1143 = t805 + t1140
    t1144 = select(t58, 0.0, t1142)
    t1145 = t1144 * t43
    t1146 = t1144 * t42
    t1147 = t1123 + t1145
    t1148 = t1120 + t1146
    t1149 = t1138 * p.LEX
    t1150 = t1138 * t55
    t1151 = t1149 * t54
    t1152 = t1149 * t48
    t1153 = -t1152
    t1154 = t1153 * t52
    t1155 = t1151 * t2
    t1156 = t1151 * t46
    t1157 = t1082 + t1156
    t1158 = t1155 * t2
    t1159 = t1155 * p.PEX3
    t1160 = t1157 + t1159
    t1161 = t1151 * p.PEX2
    t1162 = t1160 + t1161
    t1163 = t1148 * fz
    t1164 = t1147 * p.LCX
    t1165 = t1147 * p.PCX1
    t1166 = t904 * p.LMUX
    t1167 = t904 * t40
    t1168 = t1166 * p.LVX
    t1169 = t1166 * t39
    t1170 = t1168 * fz
    t1171 = t1170 * t2
    t1172 = t1170 * p.PVX2
    t1173 = t1162 + t1172
    t1174 = t1137 * p.LHX
    t1175 = t1137 * t34
    t1176 = t1174 * t2
    t1177 = t1174 * p.PHX2
    t1178 = t1173 + t1177
    t1179 = t1163 * p.LMUX
    t1180 = t1163 * t31
    t1181 = t1167 + t1180
    t1182 = t1179 * t30
    t1183 = t1179 * t27
    t1184 = -t1183
    t1185 = t1184 * gamma
    t1186 = t1185 * gamma
    t1187 = t1182 * t26
    t1188 = t1182 * t21
    t1189 = t1188 * dpi
    t1190 = t1189 * dpi
    t1191 = t1187 * t2
    t1192 = t1187 * p.PDX2
    t1193 = t1178 + t1192
    t1194 = t1143 * p.LKX
    t1195 = t1143 * t18
    t1196 = t1194 * t17
    t1197 = t1194 * t12
    t1198 = t1197 * dpi
    t1199 = t1198 * dpi
    t1200 = t1196 * t11
    t1201 = t1196 * t7
    t1202 = t1201 * t11
    t1203 = select(t495, t1202, 0.0)
    t1204 = select(t496, t1203, 0.0)
    t1205 = t1204 * t2
    t1206 = t1204 * p.PKX3
    t1207 = t1193 + t1206
    t1208 = t1200 * fz
    t1209 = t1208 * t2
    t1210 = t1208 * p.PKX2
    t1211 = t1207 + t1210
    t1212 = t1211 / t0
    t1213 = t1212 * t2
    t1214 = -t1213
    t1215 = t1119 + t1214
    t1216 = -t1212
    t1217 = t1215 + t1216
    t1218 = t1217 * p.LFZO
    t1219 = t1217 * p.FNOMIN
    t1220 = t777 + t1218
    return (
        t1220,
        t776,
        t1219,
        t1165,
        t1181,
        t1150,
        t1195,
        t1175,
        t1169,
        t1020,
        t1074,
        t1005,
        t1085,
        t1033,
        t1026,
        t758,
        t645,
        t953,
        t888,
        t810,
        t532,
        t1077,
        t642,
        t1164,
        t1187,
        t1191,
        t1186,
        t1151,
        t1155,
        t1158,
        t1154,
        t1208,
        t1209,
        t1205,
        t1174,
        t1176,
        t1170,
        t1171,
        t1019,
        t1065,
        t1069,
        t1064,
        t1008,
        t1015,
        t1011,
        t1012,
        t1101,
        t1113,
        t1097,
        t1032,
        t1034,
        t1027,
        t1028,
        t1079,
        t1080,
        t785,
        t789,
        t792,
        t788,
        t787,
        t667,
        t661,
        t745,
        t768,
        t769,
        t761,
        t762,
        t644,
        t646,
        t655,
        t658,
        t732,
        t748,
        t751,
        t746,
        t747,
        t741,
        t801,
        t797,
        t798,
        t954,
        t964,
        t930,
        t948,
        t949,
        t947,
        t889,
        t899,
        t901,
        t862,
        t883,
        t884,
        t879,
        t880,
        t830,
        t832,
        t831,
        t828,
        t814,
        t817,
        t533,
        t541,
        t535,
        t536,
        t1198,
        t1199,
        t1189,
        t1190,
        t1091,
        t1115,
        t1052,
        t1053,
        t1014,
        t1100,
        t1112,
        t1067,
        t1068,
        t1051,
        t651,
        t652,
        t766,
        t657,
        t966,
        t903,
    )


def loop_mz(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of mz; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(130 * BLOCK)
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
            w[112 * BLOCK + i] = g[106]
            w[113 * BLOCK + i] = g[107]
            w[114 * BLOCK + i] = g[108]
            w[115 * BLOCK + i] = g[109]
            w[116 * BLOCK + i] = g[110]
            w[117 * BLOCK + i] = g[111]
            w[118 * BLOCK + i] = g[112]
            w[119 * BLOCK + i] = g[113]
            w[120 * BLOCK + i] = g[114]
            w[121 * BLOCK + i] = g[115]
            w[122 * BLOCK + i] = g[116]
            w[123 * BLOCK + i] = g[117]
            w[124 * BLOCK + i] = g[118]
            w[125 * BLOCK + i] = g[119]
            w[126 * BLOCK + i] = g[120]
            w[127 * BLOCK + i] = g[121]
            w[128 * BLOCK + i] = g[122]
            w[129 * BLOCK + i] = g[123]
        for k in range(124):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]

