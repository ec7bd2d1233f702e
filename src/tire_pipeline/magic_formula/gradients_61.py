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
        "PHY3",
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
        "PHY3",
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
        "PHY3",
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
        "QYZ1",
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
    t62 = p.PHY3 * gamma
    t63 = t61 + t62
    t64 = t63 + t58
    t65 = t64 + 1.0
    t66 = t65 - 1.0
    t67 = p.PVY2 * t2
    t68 = p.PVY1 + t67
    t69 = fz * t68
    t70 = t69 * p.LVY
    t71 = t70 * p.LMUY
    t72 = t71 + t32
    t73 = alpha + t66
    t74 = p.PCY1 * p.LCY
    t75 = t45 * fz
    t76 = p.PEY2 * t2
    t77 = p.PEY1 + t76
    t78 = p.PEY5 * gamma
    t79 = t78 * gamma
    t80 = 1.0 + t79
    t81 = p.PEY4 * gamma
    t82 = p.PEY3 + t81
    t83 = t73 > 0.0
    t84 = t73 < 0.0
    t85 = select(t84, -1.0, 0.0)
    t86 = select(t83, 1.0, t85)
    t87 = t82 * t86
    t88 = t80 - t87
    t89 = t77 * t88
    t90 = t89 * p.LEY
    t91 = t74 * t75
    t92 = t91 == 0.0
    t93 = select(t92, 1.0, t91)
    t94 = t26 / t93
    t95 = select(t92, 0.0, t94)
    t96 = minimum(t90, 1.0)
    t97 = t95 * t73
    t98 = maximum(t97, -1e+150)
    t99 = minimum(t98, 1e+150)
    t100 = 1.0 - t96
    t101 = t100 * t99
    t102 = arctan(t99)
    t103 = t96 * t102
    t104 = t101 + t103
    t105 = arctan(t104)
    t106 = t74 * t105
    t107 = sin(t106)
    t108 = t75 * t107
    t109 = t108 + t72
    t110 = p.RBY4 * gamma
    t111 = t110 * gamma
    t112 = p.RBY1 + t111
    t113 = alpha - p.RBY3
    t114 = p.RBY2 * t113
    t115 = t114 * t114
    t116 = 1.0 + t115
    t117 = sqrt(t116)
    t118 = 1.0 / t117
    t119 = t112 * t118
    t120 = t119 * p.LYKA
    t121 = p.REY2 * t2
    t122 = p.REY1 + t121
    t123 = minimum(t122, 1.0)
    t124 = p.RHY2 * t2
    t125 = p.RHY1 + t124
    t126 = kappa + t125
    t127 = t120 * t126
    t128 = maximum(t127, -1e+150)
    t129 = minimum(t128, 1e+150)
    t130 = 1.0 - t123
    t131 = t130 * t129
    t132 = arctan(t129)
    t133 = t123 * t132
    t134 = t131 + t133
    t135 = arctan(t134)
    t136 = p.RCY1 * t135
    t137 = cos(t136)
    t138 = t120 * t125
    t139 = maximum(t138, -1e+150)
    t140 = minimum(t139, 1e+150)
    t141 = t130 * t140
    t142 = arctan(t140)
    t143 = t123 * t142
    t144 = t141 + t143
    t145 = arctan(t144)
    t146 = p.RCY1 * t145
    t147 = cos(t146)
    t148 = t147 == 0.0
    t149 = select(t148, 1.0, t147)
    t150 = t137 / t149
    t151 = select(t148, 0.0, t150)
    t152 = p.RVY2 * t2
    t153 = p.RVY1 + t152
    t154 = p.RVY3 * gamma
    t155 = t153 + t154
    t156 = t75 * t155
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
    t168 = p.LVYKA * t166
    t169 = p.LVYKA * t162
    t170 = cos(t165)
    t171 = t169 * t170
    t172 = t171 * t164
    t173 = t171 * p.RVY5
    t174 = t163 * t163
    t175 = 1.0 + t174
    t176 = t173 / t175
    t177 = t176 * kappa
    t178 = t168 * t161
    t179 = t168 * t156
    t180 = t179 / t160
    t181 = t180 * t161
    t182 = -t181
    t183 = t160 == 0.0
    t184 = 0.5 * t182
    t185 = t184 / t160
    t186 = select(t183, 0.0, t185)
    t187 = t186 * t157
    t188 = t187 + t187
    t189 = t188 * alpha
    t190 = t178 * t155
    t191 = t178 * t75
    t192 = t191 * gamma
    t193 = t191 * t2
    t194 = t191 * p.RVY2
    t195 = select(t148, 0.0, t109)
    t196 = t195 / t149
    t197 = t196 * t150
    t198 = -t197
    t199 = select(t148, 0.0, t198)
    t200 = sin(t146)
    t201 = t199 * t200
    t202 = -t201
    t203 = t202 * t145
    t204 = t202 * p.RCY1
    t205 = t144 * t144
    t206 = 1.0 + t205
    t207 = t204 / t206
    t208 = t207 * t142
    t209 = t207 * t123
    t210 = t140 * t140
    t211 = 1.0 + t210
    t212 = t209 / t211
    t213 = t207 * t140
    t214 = t207 * t130
    t215 = t212 + t214
    t216 = t139 < 1e+150
    t217 = select(t216, t215, 0.0)
    t218 = t138 > -1e+150
    t219 = select(t218, t217, 0.0)
    t220 = t219 * t125
    t221 = t219 * t120
    t222 = sin(t136)
    t223 = t196 * t222
    t224 = -t223
    t225 = t224 * t135
    t226 = t224 * p.RCY1
    t227 = t203 + t225
    t228 = t134 * t134
    t229 = 1.0 + t228
    t230 = t226 / t229
    t231 = t230 * t132
    t232 = t230 * t123
    t233 = t208 + t231
    t234 = t129 * t129
    t235 = 1.0 + t234
    t236 = t232 / t235
    t237 = t230 * t129
    t238 = t230 * t130
    t239 = t213 + t237
    t240 = t236 + t238
    t241 = -t239
    t242 = t233 + t241
    t243 = t128 < 1e+150
    t244 = select(t243, t240, 0.0)
    t245 = t127 > -1e+150
    t246 = select(t245, t244, 0.0)
    t247 = t246 * t126
    t248 = t246 * t120
    t249 = t220 + t247
    t250 = t221 + t248
    t251 = t250 * t2
    t252 = t250 * p.RHY2
    t253 = t194 + t252
    t254 = t122 < 1.0
    t255 = select(t254, t242, 0.0)
    t256 = t255 * t2
    t257 = t255 * p.REY2
    t258 = t253 + t257
    t259 = t249 * p.LYKA
    t260 = t249 * t119
    t261 = t259 * t118
    t262 = t259 * t112
    t263 = t262 / t117
    t264 = t263 * t118
    t265 = -t264
    t266 = t117 == 0.0
    t267 = 0.5 * t265
    t268 = t267 / t117
    t269 = select(t266, 0.0, t268)
    t270 = t269 * t114
    t271 = t270 + t270
    t272 = t271 * t113
    t273 = t271 * p.RBY2
    t274 = -t273
    t275 = t261 * gamma
    t276 = t275 * gamma
    t277 = t151 * t107
    t278 = t151 * t75
    t279 = t190 + t277
    t280 = cos(t106)
    t281 = t278 * t280
    t282 = t281 * t105
    t283 = t281 * t74
    t284 = t104 * t104
    t285 = 1.0 + t284
    t286 = t283 / t285
    t287 = t286 * t102
    t288 = t286 * t96
    t289 = t99 * t99
    t290 = 1.0 + t289
    t291 = t288 / t290
    t292 = t286 * t99
    t293 = t286 * t100
    t294 = t291 + t293
    t295 = -t292
    t296 = t287 + t295
    t297 = t98 < 1e+150
    t298 = select(t297, t294, 0.0)
    t299 = t97 > -1e+150
    t300 = select(t299, t298, 0.0)
    t301 = t300 * t73
    t302 = t300 * t95
    t303 = t90 < 1.0
    t304 = select(t303, t296, 0.0)
    t305 = select(t92, 0.0, t301)
    t306 = t305 / t93
    t307 = t306 * t94
    t308 = -t307
    t309 = select(t92, 0.0, t308)
    t310 = t309 * t75
    t311 = t309 * t74
    t312 = t282 + t310
    t313 = t279 + t311
    t314 = t304 * p.LEY
    t315 = t304 * t89
    t316 = t314 * t88
    t317 = t314 * t77
    t318 = -t317
    t319 = t318 * t86
    t320 = t319 * gamma
    t321 = t317 * gamma
    t322 = t321 * gamma
    t323 = t316 * t2
    t324 = t316 * p.PEY2
    t325 = t258 + t324
    t326 = t313 * fz
    t327 = t312 * p.LCY
    t328 = t312 * p.PCY1
    t329 = t151 * p.LMUY
    t330 = t151 * t70
    t331 = t329 * p.LVY
    t332 = t329 * t69
    t333 = t331 * fz
    t334 = t333 * t2
    t335 = t333 * p.PVY2
    t336 = t325 + t335
    t337 = t302 * gamma
    t338 = t302 * p.LHY
    t339 = t302 * t60
    t340 = t338 * t2
    t341 = t338 * p.PHY2
    t342 = t336 + t341
    t343 = select(t55, 0.0, t302)
    t344 = t343 / t56
    t345 = t344 * t57
    t346 = -t345
    t347 = select(t55, 0.0, t346)
    t348 = t306 + t347
    t349 = -t344
    t350 = t151 + t349
    t351 = t344 * gamma
    t352 = t351 * p.LKYC
    t353 = t351 * t51
    t354 = t352 * t50
    t355 = t352 * t48
    t356 = t355 * dpi
    t357 = t354 * fz
    t358 = t357 * t2
    t359 = t357 * p.PKY7
    t360 = t342 + t359
    t361 = t326 * p.LMUY
    t362 = t326 * t44
    t363 = t330 + t362
    t364 = t361 * t43
    t365 = t361 * t40
    t366 = -t365
    t367 = t366 * gamma
    t368 = t367 * gamma
    t369 = t364 * t39
    t370 = t364 * t34
    t371 = t370 * dpi
    t372 = t371 * dpi
    t373 = t369 * t2
    t374 = t369 * p.PDY2
    t375 = t360 + t374
    t376 = t350 * p.LMUY
    t377 = t350 * t31
    t378 = t363 + t377
    t379 = t376 * p.LKYC
    t380 = t376 * t30
    t381 = t353 + t380
    t382 = t379 * gamma
    t383 = t382 * fz
    t384 = t383 * t2
    t385 = t383 * p.PVY4
    t386 = t375 + t385
    t387 = t348 * p.LKY
    t388 = t348 * t25
    t389 = t387 * t24
    t390 = t387 * t21
    t391 = cos(t23)
    t392 = t390 * t391
    t393 = t392 * t22
    t394 = t392 * p.PKY4
    t395 = t13 * t13
    t396 = 1.0 + t395
    t397 = t394 / t396
    t398 = t389 * t20
    t399 = t389 * t17
    t400 = -t399
    t401 = t400 * t18
    t402 = t398 * t16
    t403 = t398 * t14
    t404 = t403 * dpi
    t405 = t402 * t0
    t406 = t402 * p.PKY1
    t407 = select(t10, 0.0, t397)
    t408 = t407 / t11
    t409 = t408 * t12
    t410 = -t409
    t411 = select(t10, 0.0, t410)
    t412 = t411 * t8
    t413 = t411 * t6
    t414 = t413 * dpi
    t415 = t412 * gamma
    t416 = t415 * gamma
    t417 = t408 / t0
    t418 = t417 * t3
    t419 = -t418
    t420 = t406 + t419
    t421 = t386 / t0
    t422 = t421 * t2
    t423 = -t422
    t424 = t420 + t423
    t425 = -t421
    t426 = t424 + t425
    t427 = t426 * p.LFZO
    t428 = t426 * p.FNOMIN
    return (
        t427,
        t428,
        t328,
        t378,
        t315,
        t388,
        t339,
        t332,
        t260,
        t167,
        t381,
        t327,
        t369,
        t373,
        t368,
        t316,
        t323,
        t319,
        t320,
        t405,
        t412,
        t401,
        t338,
        t340,
        t333,
        t334,
        t383,
        t384,
        t261,
        t272,
        t274,
        t227,
        t255,
        t256,
        t250,
        t251,
        t191,
        t193,
        t192,
        t189,
        t172,
        t177,
        t337,
        t393,
        t416,
        t357,
        t358,
        t322,
        t404,
        t414,
        t371,
        t372,
        t356,
        t276,
    )


def loop_fy(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of fy; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(60 * BLOCK)
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
            w[59 * BLOCK + i] = g[53]
        for k in range(54):
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
    t63 = p.PHY3 * gamma
    t64 = t62 + t63
    t65 = t64 + t59
    t66 = t65 + 1.0
    t67 = t66 - 1.0
    t68 = p.PVY2 * t3
    t69 = p.PVY1 + t68
    t70 = fz * t69
    t71 = t70 * p.LVY
    t72 = t71 * p.LMUY
    t73 = t72 + t33
    t74 = alpha + t67
    t75 = p.PCY1 * p.LCY
    t76 = t46 * fz
    t77 = p.PEY2 * t3
    t78 = p.PEY1 + t77
    t79 = p.PEY5 * gamma
    t80 = t79 * gamma
    t81 = 1.0 + t80
    t82 = p.PEY4 * gamma
    t83 = p.PEY3 + t82
    t84 = t74 > 0.0
    t85 = t74 < 0.0
    t86 = select(t85, -1.0, 0.0)
    t87 = select(t84, 1.0, t86)
    t88 = t83 * t87
    t89 = t81 - t88
    t90 = t78 * t89
    t91 = t90 * p.LEY
    t92 = t75 * t76
    t93 = t92 == 0.0
    t94 = select(t93, 1.0, t92)
    t95 = t27 / t94
    t96 = select(t93, 0.0, t95)
    t97 = minimum(t91, 1.0)
    t98 = t96 * t74
    t99 = maximum(t98, -1e+150)
    t100 = minimum(t99, 1e+150)
    t101 = 1.0 - t97
    t102 = t101 * t100
    t103 = arctan(t100)
    t104 = t97 * t103
    t105 = t102 + t104
    t106 = arctan(t105)
    t107 = t75 * t106
    t108 = sin(t107)
    t109 = t76 * t108
    t110 = t109 + t73
    t111 = p.RBY4 * gamma
    t112 = t111 * gamma
    t113 = p.RBY1 + t112
    t114 = alpha - p.RBY3
    t115 = p.RBY2 * t114
    t116 = t115 * t115
    t117 = 1.0 + t116
    t118 = sqrt(t117)
    t119 = 1.0 / t118
    t120 = t113 * t119
    t121 = t120 * p.LYKA
    t122 = p.REY2 * t3
    t123 = p.REY1 + t122
    t124 = minimum(t123, 1.0)
    t125 = p.RHY2 * t3
    t126 = p.RHY1 + t125
    t127 = kappa + t126
    t128 = t121 * t127
    t129 = maximum(t128, -1e+150)
    t130 = minimum(t129, 1e+150)
    t131 = 1.0 - t124
    t132 = t131 * t130
    t133 = arctan(t130)
    t134 = t124 * t133
    t135 = t132 + t134
    t136 = arctan(t135)
    t137 = p.RCY1 * t136
    t138 = cos(t137)
    t139 = t121 * t126
    t140 = maximum(t139, -1e+150)
    t141 = minimum(t140, 1e+150)
    t142 = t131 * t141
    t143 = arctan(t141)
    t144 = t124 * t143
    t145 = t142 + t144
    t146 = arctan(t145)
    t147 = p.RCY1 * t146
    t148 = cos(t147)
    t149 = t148 == 0.0
    t150 = select(t149, 1.0, t148)
    t151 = t138 / t150
    t152 = select(t149, 0.0, t151)
    t153 = t110 * t152
    t154 = p.RVY2 * t3
    t155 = p.RVY1 + t154
    t156 = p.RVY3 * gamma
    t157 = t155 + t156
    t158 = t76 * t157
    t159 = p.RVY4 * alpha
    t160 = t159 * t159
    t161 = 1.0 + t160
    t162 = sqrt(t161)
    t163 = 1.0 / t162
    t164 = t158 * t163
    t165 = p.RVY6 * kappa
    t166 = arctan(t165)
    t167 = p.RVY5 * t166
    t168 = sin(t167)
    t169 = t164 * t168
    t170 = t169 * p.LVYKA
    t171 = t153 + t170
    t172 = t171 / p.FNOMIN
    t173 = p.QSX6 * t0
    t174 = p.QSX1 * p.LVMX
    t175 = p.QSX2 * gamma
    t176 = p.PPMX1 * dpi
    t177 = 1.0 + t176
    t178 = t175 * t177
    t179 = t174 - t178
    t180 = p.QSX12 * gamma
    t181 = t180 * t19
    t182 = t179 - t181
    t183 = p.QSX3 * t172
    t184 = t182 + t183
    t185 = t173 * t173
    t186 = arctan(t185)
    t187 = p.QSX5 * t186
    t188 = cos(t187)
    t189 = p.QSX4 * t188
    t190 = p.QSX7 * gamma
    t191 = p.QSX9 * t172
    t192 = arctan(t191)
    t193 = p.QSX8 * t192
    t194 = t190 + t193
    t195 = sin(t194)
    t196 = t189 * t195
    t197 = t184 + t196
    t198 = p.QSX11 * t0
    t199 = arctan(t198)
    t200 = p.QSX10 * t199
    t201 = t200 * gamma
    t202 = t197 + t201
    t203 = p.UNLOADED_RADIUS * p.LMX
    t204 = fz * t202
    t205 = p.QSX14 * t19
    t206 = p.QSX13 + t205
    t207 = t171 * t206
    t208 = t204 + t207
    t209 = cos(t167)
    t210 = t165 * t165
    t211 = 1.0 + t210
    t212 = t162 == 0.0
    t213 = sin(t147)
    t214 = t145 * t145
    t215 = 1.0 + t214
    t216 = t141 * t141
    t217 = 1.0 + t216
    t218 = t140 < 1e+150
    t219 = t139 > -1e+150
    t220 = sin(t137)
    t221 = t135 * t135
    t222 = 1.0 + t221
    t223 = t130 * t130
    t224 = 1.0 + t223
    t225 = t129 < 1e+150
    t226 = t128 > -1e+150
    t227 = t123 < 1.0
    t228 = t118 == 0.0
    t229 = cos(t107)
    t230 = t105 * t105
    t231 = 1.0 + t230
    t232 = t100 * t100
    t233 = 1.0 + t232
    t234 = t99 < 1e+150
    t235 = t98 > -1e+150
    t236 = t91 < 1.0
    t237 = cos(t24)
    t238 = t14 * t14
    t239 = 1.0 + t238
    t240 = t203 * t206
    t241 = t203 * t171
    t242 = t241 * t19
    t243 = t203 * fz
    t244 = t208 * p.LMX
    t245 = t208 * p.UNLOADED_RADIUS
    t246 = t243 * gamma
    t247 = t246 * t199
    t248 = t246 * p.QSX10
    t249 = t198 * t198
    t250 = 1.0 + t249
    t251 = t248 / t250
    t252 = t251 * t0
    t253 = t251 * p.QSX11
    t254 = t243 * t195
    t255 = t243 * t189
    t256 = cos(t194)
    t257 = t255 * t256
    t258 = t257 * t192
    t259 = t257 * p.QSX8
    t260 = t191 * t191
    t261 = 1.0 + t260
    t262 = t259 / t261
    t263 = t262 * t172
    t264 = t262 * p.QSX9
    t265 = t257 * gamma
    t266 = t254 * t188
    t267 = t254 * p.QSX4
    t268 = sin(t187)
    t269 = t267 * t268
    t270 = -t269
    t271 = t270 * t186
    t272 = t270 * p.QSX5
    t273 = t185 * t185
    t274 = 1.0 + t273
    t275 = t272 / t274
    t276 = t275 * t173
    t277 = t276 + t276
    t278 = t243 * t172
    t279 = t243 * p.QSX3
    t280 = t264 + t279
    t281 = -t243
    t282 = t281 * t19
    t283 = t282 * gamma
    t284 = t281 * t177
    t285 = t281 * t175
    t286 = t285 * dpi
    t287 = t284 * gamma
    t288 = t243 * p.LVMX
    t289 = t243 * p.QSX1
    t290 = t277 * t0
    t291 = t277 * p.QSX6
    t292 = t253 + t291
    t293 = t280 / p.FNOMIN
    t294 = t293 * t172
    t295 = -t294
    t296 = t240 + t293
    t297 = t296 * p.LVYKA
    t298 = t296 * t169
    t299 = t297 * t168
    t300 = t297 * t164
    t301 = t300 * t209
    t302 = t301 * t166
    t303 = t301 * p.RVY5
    t304 = t303 / t211
    t305 = t304 * kappa
    t306 = t299 * t163
    t307 = t299 * t158
    t308 = t307 / t162
    t309 = t308 * t163
    t310 = -t309
    t311 = 0.5 * t310
    t312 = t311 / t162
    t313 = select(t212, 0.0, t312)
    t314 = t313 * t159
    t315 = t314 + t314
    t316 = t315 * alpha
    t317 = t306 * t157
    t318 = t306 * t76
    t319 = t318 * gamma
    t320 = t318 * t3
    t321 = t318 * p.RVY2
    t322 = t296 * t152
    t323 = t296 * t110
    t324 = select(t149, 0.0, t323)
    t325 = t324 / t150
    t326 = t325 * t151
    t327 = -t326
    t328 = select(t149, 0.0, t327)
    t329 = t328 * t213
    t330 = -t329
    t331 = t330 * t146
    t332 = t330 * p.RCY1
    t333 = t332 / t215
    t334 = t333 * t143
    t335 = t333 * t124
    t336 = t335 / t217
    t337 = t333 * t141
    t338 = t333 * t131
    t339 = t336 + t338
    t340 = select(t218, t339, 0.0)
    t341 = select(t219, t340, 0.0)
    t342 = t341 * t126
    t343 = t341 * t121
    t344 = t325 * t220
    t345 = -t344
    t346 = t345 * t136
    t347 = t345 * p.RCY1
    t348 = t331 + t346
    t349 = t347 / t222
    t350 = t349 * t133
    t351 = t349 * t124
    t352 = t334 + t350
    t353 = t351 / t224
    t354 = t349 * t130
    t355 = t349 * t131
    t356 = t337 + t354
    t357 = t353 + t355
    t358 = -t356
    t359 = t352 + t358
    t360 = select(t225, t357, 0.0)
    t361 = select(t226, t360, 0.0)
    t362 = t361 * t127
    t363 = t361 * t121
    t364 = t342 + t362
    t365 = t343 + t363
    t366 = t365 * t3
    t367 = t365 * p.RHY2
    t368 = t321 + t367
    t369 = select(t227, t359, 0.0)
    t370 = t369 * t3
    t371 = t369 * p.REY2
    t372 = t368 + t371
    t373 = t364 * p.LYKA
    t374 = t364 * t120
    t375 = t373 * t119
    t376 = t373 * t113
    t377 = t376 / t118
    t378 = t377 * t119
    t379 = -t378
    t380 = 0.5 * t379
    t381 = t380 / t118
    t382 = select(t228, 0.0, t381)
    t383 = t382 * t115
    t384 = t383 + t383
    t385 = t384 * t114
    t386 = t384 * p.RBY2
    t387 = -t386
    t388 = t375 * gamma
    t389 = t388 * gamma
    t390 = t322 * t108
    t391 = t322 * t76
    t392 = t317 + t390
    t393 = t391 * t229
    t394 = t393 * t106
    t395 = t393 * t75
    t396 = t395 / t231
    t397 = t396 * t103
    t398 = t396 * t97
    t399 = t398 / t233
    t400 = t396 * t100
    t401 = t396 * t101
    t402 = t399 + t401
    t403 = -t400
    t404 = t397 + t403
    t405 = select(t234, t402, 0.0)
    t406 = select(t235, t405, 0.0)
    t407 = t406 * t74
    t408 = t406 * t96
    t409 = select(t236, t404, 0.0)
    t410 = select(t93, 0.0, t407)
    t411 = t410 / t94
    t412 = t411 * t95
    t413 = -t412
    t414 = select(t93, 0.0, t413)
    t415 = t414 * t76
    t416 = t414 * t75
    t417 = t394 + t415
    t418 = t392 + t416
    t419 = t409 * p.LEY
    t420 = t409 * t90
    t421 = t419 * t89
    t422 = t419 * t78
    t423 = -t422
    t424 = t423 * t87
    t425 = t424 * gamma
    t426 = t422 * gamma
    t427 = t426 * gamma
    t428 = t421 * t3
    t429 = t421 * p.PEY2
    t430 = t372 + t429
    t431 = t418 * fz
    t432 = t417 * p.LCY
    t433 = t417 * p.PCY1
    t434 = t322 * p.LMUY
    t435 = t322 * t71
    t436 = t434 * p.LVY
    t437 = t434 * t70
    t438 = t436 * fz
    t439 = t438 * t3
    t440 = t438 * p.PVY2
    t441 = t430 + t440
    t442 = t408 * gamma
    t443 = t408 * p.LHY
    t444 = t408 * t61
    t445 = t443 * t3
    t446 = t443 * p.PHY2
    t447 = t441 + t446
    t448 = select(t56, 0.0, t408)
    t449 = t448 / t57
    t450 = t449 * t58
    t451 = -t450
    t452 = select(t56, 0.0, t451)
    t453 = t411 + t452
    t454 = -t449
    t455 = t322 + t454
    t456 = t449 * gamma
    t457 = t456 * p.LKYC
    t458 = t456 * t52
    t459 = t457 * t51
    t460 = t457 * t49
    t461 = t460 * dpi
    t462 = t459 * fz
    t463 = t462 * t3
    t464 = t462 * p.PKY7
    t465 = t447 + t464
    t466 = t431 * p.LMUY
    t467 = t431 * t45
    t468 = t435 + t467
    t469 = t466 * t44
    t470 = t466 * t41
    t471 = -t470
    t472 = t471 * gamma
    t473 = t472 * gamma
    t474 = t469 * t40
    t475 = t469 * t35
    t476 = t475 * dpi
    t477 = t476 * dpi
    t478 = t474 * t3
    t479 = t474 * p.PDY2
    t480 = t465 + t479
    t481 = t455 * p.LMUY
    t482 = t455 * t32
    t483 = t468 + t482
    t484 = t481 * p.LKYC
    t485 = t481 * t31
    t486 = t458 + t485
    t487 = t484 * gamma
    t488 = t487 * fz
    t489 = t488 * t3
    t490 = t488 * p.PVY4
    t491 = t480 + t490
    t492 = t453 * p.LKY
    t493 = t453 * t26
    t494 = t492 * t25
    t495 = t492 * t22
    t496 = t495 * t237
    t497 = t496 * t23
    t498 = t496 * p.PKY4
    t499 = t498 / t239
    t500 = t494 * t21
    t501 = t494 * t18
    t502 = -t501
    t503 = t502 * t19
    t504 = t500 * t17
    t505 = t500 * t15
    t506 = t505 * dpi
    t507 = t504 * t1
    t508 = t504 * p.PKY1
    t509 = select(t11, 0.0, t499)
    t510 = t509 / t12
    t511 = t510 * t13
    t512 = -t511
    t513 = select(t11, 0.0, t512)
    t514 = t513 * t9
    t515 = t513 * t7
    t516 = t515 * dpi
    t517 = t514 * gamma
    t518 = t517 * gamma
    t519 = t510 / t1
    t520 = t519 * t4
    t521 = -t520
    t522 = t508 + t521
    t523 = t491 / t1
    t524 = t523 * t3
    t525 = -t524
    t526 = t522 + t525
    t527 = -t523
    t528 = t526 + t527
    t529 = t528 * p.LFZO
    t530 = t528 * p.FNOMIN
    t531 = t295 + t529
    t532 = t292 / p.FNOMIN
    t533 = t532 * t0
    t534 = -t533
    t535 = t531 + t534
    return (
        t535,
        t244,
        t530,
        t433,
        t483,
        t420,
        t493,
        t444,
        t437,
        t374,
        t298,
        t245,
        t289,
        t486,
        t432,
        t474,
        t478,
        t473,
        t421,
        t428,
        t424,
        t425,
        t507,
        t514,
        t503,
        t443,
        t445,
        t438,
        t439,
        t488,
        t489,
        t375,
        t385,
        t387,
        t348,
        t369,
        t370,
        t365,
        t366,
        t318,
        t320,
        t319,
        t316,
        t302,
        t305,
        t288,
        t287,
        t278,
        t442,
        t497,
        t518,
        t462,
        t463,
        t427,
        t506,
        t516,
        t476,
        t477,
        t461,
        t389,
        t266,
        t271,
        t290,
        t265,
        t258,
        t263,
        t247,
        t252,
        t283,
        t241,
        t242,
        t286,
    )


def loop_mx(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of mx; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(78 * BLOCK)
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
            w[77 * BLOCK + i] = g[71]
        for k in range(72):
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
    t135 = p.PHY3 * gamma
    t136 = t134 + t135
    t137 = t136 + t131
    t138 = t137 + 1.0
    t139 = t138 - 1.0
    t140 = p.PVY2 * t2
    t141 = p.PVY1 + t140
    t142 = fz * t141
    t143 = t142 * p.LVY
    t144 = t143 * p.LMUY
    t145 = t144 + t105
    t146 = alpha + t139
    t147 = p.PCY1 * p.LCY
    t148 = t118 * fz
    t149 = p.PEY2 * t2
    t150 = p.PEY1 + t149
    t151 = p.PEY5 * gamma
    t152 = t151 * gamma
    t153 = 1.0 + t152
    t154 = p.PEY4 * gamma
    t155 = p.PEY3 + t154
    t156 = t146 > 0.0
    t157 = t146 < 0.0
    t158 = select(t157, -1.0, 0.0)
    t159 = select(t156, 1.0, t158)
    t160 = t155 * t159
    t161 = t153 - t160
    t162 = t150 * t161
    t163 = t162 * p.LEY
    t164 = t147 * t148
    t165 = t164 == 0.0
    t166 = select(t165, 1.0, t164)
    t167 = t99 / t166
    t168 = select(t165, 0.0, t167)
    t169 = minimum(t163, 1.0)
    t170 = t168 * t146
    t171 = maximum(t170, -1e+150)
    t172 = minimum(t171, 1e+150)
    t173 = 1.0 - t169
    t174 = t173 * t172
    t175 = arctan(t172)
    t176 = t169 * t175
    t177 = t174 + t176
    t178 = arctan(t177)
    t179 = t147 * t178
    t180 = sin(t179)
    t181 = t148 * t180
    t182 = t181 + t145
    t183 = t168 * t147
    t184 = p.RBX3 * gamma
    t185 = t184 * gamma
    t186 = p.RBX1 + t185
    t187 = p.RBX2 * kappa
    t188 = t187 * t187
    t189 = 1.0 + t188
    t190 = sqrt(t189)
    t191 = 1.0 / t190
    t192 = t186 * t191
    t193 = t192 * p.LXAL
    t194 = p.REX2 * t2
    t195 = p.REX1 + t194
    t196 = minimum(t195, 1.0)
    t197 = alpha + p.RHX1
    t198 = t193 * t197
    t199 = maximum(t198, -1e+150)
    t200 = minimum(t199, 1e+150)
    t201 = 1.0 - t196
    t202 = t201 * t200
    t203 = arctan(t200)
    t204 = t196 * t203
    t205 = t202 + t204
    t206 = arctan(t205)
    t207 = p.RCX1 * t206
    t208 = cos(t207)
    t209 = t193 * p.RHX1
    t210 = maximum(t209, -1e+150)
    t211 = minimum(t210, 1e+150)
    t212 = t201 * t211
    t213 = arctan(t211)
    t214 = t196 * t213
    t215 = t212 + t214
    t216 = arctan(t215)
    t217 = p.RCX1 * t216
    t218 = cos(t217)
    t219 = t218 == 0.0
    t220 = select(t219, 1.0, t218)
    t221 = t208 / t220
    t222 = select(t219, 0.0, t221)
    t223 = t75 * t222
    t224 = p.RBY4 * gamma
    t225 = t224 * gamma
    t226 = p.RBY1 + t225
    t227 = alpha - p.RBY3
    t228 = p.RBY2 * t227
    t229 = t228 * t228
    t230 = 1.0 + t229
    t231 = sqrt(t230)
    t232 = 1.0 / t231
    t233 = t226 * t232
    t234 = t233 * p.LYKA
    t235 = p.REY2 * t2
    t236 = p.REY1 + t235
    t237 = minimum(t236, 1.0)
    t238 = p.RHY2 * t2
    t239 = p.RHY1 + t238
    t240 = kappa + t239
    t241 = t234 * t240
    t242 = maximum(t241, -1e+150)
    t243 = minimum(t242, 1e+150)
    t244 = 1.0 - t237
    t245 = t244 * t243
    t246 = arctan(t243)
    t247 = t237 * t246
    t248 = t245 + t247
    t249 = arctan(t248)
    t250 = p.RCY1 * t249
    t251 = cos(t250)
    t252 = t234 * t239
    t253 = maximum(t252, -1e+150)
    t254 = minimum(t253, 1e+150)
    t255 = t244 * t254
    t256 = arctan(t254)
    t257 = t237 * t256
    t258 = t255 + t257
    t259 = arctan(t258)
    t260 = p.RCY1 * t259
    t261 = cos(t260)
    t262 = t261 == 0.0
    t263 = select(t262, 1.0, t261)
    t264 = t251 / t263
    t265 = select(t262, 0.0, t264)
    t266 = t182 * t265
    t267 = p.RVY2 * t2
    t268 = p.RVY1 + t267
    t269 = p.RVY3 * gamma
    t270 = t268 + t269
    t271 = t148 * t270
    t272 = p.RVY4 * alpha
    t273 = t272 * t272
    t274 = 1.0 + t273
    t275 = sqrt(t274)
    t276 = 1.0 / t275
    t277 = t271 * t276
    t278 = p.RVY6 * kappa
    t279 = arctan(t278)
    t280 = p.RVY5 * t279
    t281 = sin(t280)
    t282 = t277 * t281
    t283 = t282 * p.LVYKA
    t284 = t266 + t283
    t285 = t19 / t129
    t286 = select(t128, 0.0, t285)
    t287 = alpha + p.QHZ1
    t288 = p.QHZ2 * t2
    t289 = t287 + t288
    t290 = p.QHZ4 * t2
    t291 = p.QHZ3 + t290
    t292 = t291 * gamma
    t293 = t289 + t292
    t294 = p.QBZ2 * t2
    t295 = p.QBZ1 + t294
    t296 = p.QBZ3 * t2
    t297 = t296 * t2
    t298 = t295 + t297
    t299 = p.QBZ4 * gamma
    t300 = 1.0 + t299
    t301 = p.QBZ5 * t91
    t302 = t300 + t301
    t303 = t298 * t302
    t304 = t303 * p.LKY
    t305 = t304 / p.LMUY
    t306 = p.UNLOADED_RADIUS / p.FNOMIN
    t307 = fz * t306
    t308 = p.QDZ2 * t2
    t309 = p.QDZ1 + t308
    t310 = t307 * t309
    t311 = p.PPZ1 * dpi
    t312 = 1.0 - t311
    t313 = t310 * t312
    t314 = p.QDZ3 * gamma
    t315 = 1.0 + t314
    t316 = p.QDZ4 * gamma
    t317 = t316 * gamma
    t318 = t315 + t317
    t319 = t313 * t318
    t320 = t319 * p.LTR
    t321 = t320 * t4
    t322 = p.QEZ2 * t2
    t323 = p.QEZ1 + t322
    t324 = p.QEZ3 * t2
    t325 = t324 * t2
    t326 = t323 + t325
    t327 = p.QEZ5 * gamma
    t328 = p.QEZ4 + t327
    t329 = t328 * 0.6366197723675814
    t330 = t305 * p.QCZ1
    t331 = t330 * t293
    t332 = arctan(t331)
    t333 = t329 * t332
    t334 = 1.0 + t333
    t335 = t326 * t334
    t336 = sin(t293)
    t337 = cos(t293)
    t338 = t337 == 0.0
    t339 = select(t338, 1.0, t337)
    t340 = t336 / t339
    t341 = select(t338, 0.0, t340)
    t342 = maximum(t286, -1e+150)
    t343 = minimum(t342, 1e+150)
    t344 = t343 * kappa
    t345 = t341 * t341
    t346 = t344 * t344
    t347 = minimum(t346, 9.999999999999999e+299)
    t348 = t345 + t347
    t349 = sqrt(t348)
    t350 = arctan(t349)
    t351 = t293 > 0.0
    t352 = t293 < 0.0
    t353 = select(t352, -1.0, 0.0)
    t354 = select(t351, 1.0, t353)
    t355 = t350 * t354
    t356 = minimum(t335, 1.0)
    t357 = t305 * t355
    t358 = maximum(t357, -1e+150)
    t359 = minimum(t358, 1e+150)
    t360 = 1.0 - t356
    t361 = t360 * t359
    t362 = arctan(t359)
    t363 = t356 * t362
    t364 = t361 + t363
    t365 = arctan(t364)
    t366 = p.QCZ1 * t365
    t367 = cos(t366)
    t368 = t321 * t367
    t369 = cos(alpha)
    t370 = t368 * t369
    t371 = t145 / t129
    t372 = select(t128, 0.0, t371)
    t373 = t146 + t372
    t374 = p.QBZ9 * p.LKY
    t375 = t374 / p.LMUY
    t376 = p.QBZ10 * t183
    t377 = t375 + t376
    t378 = p.QDZ9 * t2
    t379 = p.QDZ8 + t378
    t380 = p.PPZ2 * dpi
    t381 = 1.0 + t380
    t382 = t379 * t381
    t383 = p.QDZ11 * t2
    t384 = p.QDZ10 + t383
    t385 = t384 * t91
    t386 = t382 + t385
    t387 = fz * p.UNLOADED_RADIUS
    t388 = p.QDZ7 * t2
    t389 = p.QDZ6 + t388
    t390 = t389 * p.LRES
    t391 = t386 * gamma
    t392 = t391 * p.LKZC
    t393 = t390 + t392
    t394 = t387 * t393
    t395 = t394 * p.LMUY
    t396 = t395 * t4
    t397 = t396 + 1.0
    t398 = t397 - 1.0
    t399 = sin(t373)
    t400 = cos(t373)
    t401 = t400 == 0.0
    t402 = select(t401, 1.0, t400)
    t403 = t399 / t402
    t404 = select(t401, 0.0, t403)
    t405 = t404 * t404
    t406 = t405 + t347
    t407 = sqrt(t406)
    t408 = arctan(t407)
    t409 = t373 > 0.0
    t410 = t373 < 0.0
    t411 = select(t410, -1.0, 0.0)
    t412 = select(t409, 1.0, t411)
    t413 = t408 * t412
    t414 = t377 * t413
    t415 = arctan(t414)
    t416 = cos(t415)
    t417 = p.PKY2 * t81
    t418 = t417 == 0.0
    t419 = select(t418, 1.0, t417)
    t420 = t76 / t419
    t421 = select(t418, 0.0, t420)
    t422 = arctan(t421)
    t423 = p.PKY4 * t422
    t424 = sin(t423)
    t425 = t90 * t424
    t426 = t425 * p.LKY
    t427 = t113 * p.LMUY
    t428 = t426 == 0.0
    t429 = select(t428, 0.0, 0.0)
    t430 = t134 + t429
    t431 = t430 + 1.0
    t432 = t431 - 1.0
    t433 = alpha + t432
    t434 = t427 * fz
    t435 = t433 > 0.0
    t436 = t433 < 0.0
    t437 = select(t436, -1.0, 0.0)
    t438 = select(t435, 1.0, t437)
    t439 = p.PEY3 * t438
    t440 = 1.0 - t439
    t441 = t150 * t440
    t442 = t441 * p.LEY
    t443 = t147 * t434
    t444 = t443 == 0.0
    t445 = select(t444, 1.0, t443)
    t446 = t426 / t445
    t447 = select(t444, 0.0, t446)
    t448 = minimum(t442, 1.0)
    t449 = t447 * t433
    t450 = maximum(t449, -1e+150)
    t451 = minimum(t450, 1e+150)
    t452 = 1.0 - t448
    t453 = t452 * t451
    t454 = arctan(t451)
    t455 = t448 * t454
    t456 = t453 + t455
    t457 = arctan(t456)
    t458 = t147 * t457
    t459 = sin(t458)
    t460 = t434 * t459
    t461 = t460 + t144
    t462 = p.SSZ2 * t284
    t463 = t462 / p.FNOMIN
    t464 = p.SSZ1 + t463
    t465 = p.SSZ4 * t2
    t466 = p.SSZ3 + t465
    t467 = t466 * gamma
    t468 = t464 + t467
    t469 = t468 * p.UNLOADED_RADIUS
    t470 = t469 * p.LS
    t471 = t182 - t461
    t472 = p.QYZ1 * t471
    t473 = t461 + t472
    t474 = t265 * t473
    t475 = -t370
    t476 = sin(t217)
    t477 = t215 * t215
    t478 = 1.0 + t477
    t479 = t211 * t211
    t480 = 1.0 + t479
    t481 = t210 < 1e+150
    t482 = t209 > -1e+150
    t483 = sin(t207)
    t484 = t205 * t205
    t485 = 1.0 + t484
    t486 = t200 * t200
    t487 = 1.0 + t486
    t488 = t199 < 1e+150
    t489 = t198 > -1e+150
    t490 = t195 < 1.0
    t491 = t190 == 0.0
    t492 = cos(t72)
    t493 = t70 * t70
    t494 = 1.0 + t493
    t495 = t65 * t65
    t496 = 1.0 + t495
    t497 = t64 < 1e+150
    t498 = t63 > -1e+150
    t499 = t56 < 1.0
    t500 = t9 < 100.0
    t501 = t8 > -700.0
    t502 = cos(t280)
    t503 = t278 * t278
    t504 = 1.0 + t503
    t505 = t275 == 0.0
    t506 = sin(t260)
    t507 = t258 * t258
    t508 = 1.0 + t507
    t509 = t254 * t254
    t510 = 1.0 + t509
    t511 = t253 < 1e+150
    t512 = t252 > -1e+150
    t513 = sin(t250)
    t514 = t248 * t248
    t515 = 1.0 + t514
    t516 = t243 * t243
    t517 = 1.0 + t516
    t518 = t242 < 1e+150
    t519 = t241 > -1e+150
    t520 = t236 < 1.0
    t521 = t231 == 0.0
    t522 = cos(t179)
    t523 = t177 * t177
    t524 = 1.0 + t523
    t525 = t172 * t172
    t526 = 1.0 + t525
    t527 = t171 < 1e+150
    t528 = t170 > -1e+150
    t529 = t163 < 1.0
    t530 = cos(t96)
    t531 = t86 * t86
    t532 = 1.0 + t531
    t533 = -t474
    t534 = t475 * t473
    t535 = t475 * t265
    t536 = t535 * t471
    t537 = t535 * p.QYZ1
    t538 = -t537
    t539 = t535 + t538
    t540 = t223 * p.LS
    t541 = t223 * t469
    t542 = t540 * p.UNLOADED_RADIUS
    t543 = t540 * t468
    t544 = t542 * gamma
    t545 = t544 * t2
    t546 = t544 * p.SSZ4
    t547 = t542 / p.FNOMIN
    t548 = t547 * t463
    t549 = -t548
    t550 = t547 * t284
    t551 = t547 * p.SSZ2
    t552 = t539 * t459
    t553 = t539 * t434
    t554 = cos(t458)
    t555 = t553 * t554
    t556 = t555 * t457
    t557 = t555 * t147
    t558 = t456 * t456
    t559 = 1.0 + t558
    t560 = t557 / t559
    t561 = t560 * t454
    t562 = t560 * t448
    t563 = t451 * t451
    t564 = 1.0 + t563
    t565 = t562 / t564
    t566 = t560 * t451
    t567 = t560 * t452
    t568 = t565 + t567
    t569 = -t566
    t570 = t561 + t569
    t571 = t450 < 1e+150
    t572 = select(t571, t568, 0.0)
    t573 = t449 > -1e+150
    t574 = select(t573, t572, 0.0)
    t575 = t574 * t433
    t576 = t574 * t447
    t577 = t442 < 1.0
    t578 = select(t577, t570, 0.0)
    t579 = select(t444, 0.0, t575)
    t580 = t579 / t445
    t581 = t580 * t446
    t582 = -t581
    t583 = select(t444, 0.0, t582)
    t584 = t583 * t434
    t585 = t583 * t147
    t586 = t556 + t584
    t587 = t552 + t585
    t588 = t578 * p.LEY
    t589 = t578 * t441
    t590 = t588 * t440
    t591 = t588 * t150
    t592 = -t591
    t593 = t592 * t438
    t594 = t587 * fz
    t595 = t594 * p.LMUY
    t596 = t594 * t113
    t597 = t580 * p.LKY
    t598 = t580 * t425
    t599 = t597 * t424
    t600 = t597 * t90
    t601 = cos(t423)
    t602 = t600 * t601
    t603 = t602 * t422
    t604 = t602 * p.PKY4
    t605 = t421 * t421
    t606 = 1.0 + t605
    t607 = t604 / t606
    t608 = select(t418, 0.0, t607)
    t609 = t608 / t419
    t610 = t609 * t420
    t611 = -t610
    t612 = select(t418, 0.0, t611)
    t613 = t612 * t81
    t614 = t612 * p.PKY2
    t615 = t369 * t416
    t616 = t369 * t398
    t617 = sin(t415)
    t618 = t616 * t617
    t619 = -t618
    t620 = t414 * t414
    t621 = 1.0 + t620
    t622 = t619 / t621
    t623 = t622 * t413
    t624 = t622 * t377
    t625 = t624 * t412
    t626 = t407 * t407
    t627 = 1.0 + t626
    t628 = t625 / t627
    t629 = t407 == 0.0
    t630 = 0.5 * t628
    t631 = t630 / t407
    t632 = select(t629, 0.0, t631)
    t633 = t632 * t404
    t634 = t633 + t633
    t635 = select(t401, 0.0, t634)
    t636 = t635 / t402
    t637 = t636 * t403
    t638 = -t637
    t639 = select(t401, 0.0, t638)
    t640 = t639 * t399
    t641 = -t640
    t642 = t636 * t400
    t643 = t641 + t642
    t644 = t615 * t4
    t645 = t644 * p.LMUY
    t646 = t644 * t394
    t647 = t596 + t646
    t648 = t645 * t393
    t649 = t645 * t387
    t650 = t649 * p.LKZC
    t651 = t649 * t391
    t652 = t650 * gamma
    t653 = t649 * p.LRES
    t654 = t649 * t389
    t655 = t653 * t2
    t656 = t653 * p.QDZ7
    t657 = t546 + t656
    t658 = t648 * fz
    t659 = t543 + t658
    t660 = t652 * t91
    t661 = t660 * t2
    t662 = t660 * p.QDZ11
    t663 = t657 + t662
    t664 = t652 * t381
    t665 = t652 * t379
    t666 = t665 * dpi
    t667 = t664 * t2
    t668 = t664 * p.QDZ9
    t669 = t663 + t668
    t670 = t623 * t183
    t671 = t623 * p.QBZ10
    t672 = t623 / p.LMUY
    t673 = t672 * t375
    t674 = -t673
    t675 = t647 + t674
    t676 = t672 * p.LKY
    t677 = t672 * p.QBZ9
    t678 = t598 + t677
    t679 = select(t128, 0.0, t643)
    t680 = t679 / t129
    t681 = t680 * t371
    t682 = -t681
    t683 = t533 * t369
    t684 = t683 * t367
    t685 = t683 * t321
    t686 = sin(t366)
    t687 = t685 * t686
    t688 = -t687
    t689 = t688 * t365
    t690 = t688 * p.QCZ1
    t691 = t364 * t364
    t692 = 1.0 + t691
    t693 = t690 / t692
    t694 = t693 * t362
    t695 = t693 * t356
    t696 = t359 * t359
    t697 = 1.0 + t696
    t698 = t695 / t697
    t699 = t693 * t359
    t700 = t693 * t360
    t701 = t698 + t700
    t702 = -t699
    t703 = t694 + t702
    t704 = t358 < 1e+150
    t705 = select(t704, t701, 0.0)
    t706 = t357 > -1e+150
    t707 = select(t706, t705, 0.0)
    t708 = t707 * t355
    t709 = t707 * t305
    t710 = t335 < 1.0
    t711 = select(t710, t703, 0.0)
    t712 = t709 * t354
    t713 = t349 * t349
    t714 = 1.0 + t713
    t715 = t712 / t714
    t716 = t349 == 0.0
    t717 = 0.5 * t715
    t718 = t717 / t349
    t719 = select(t716, 0.0, t718)
    t720 = t632 + t719
    t721 = t346 < 9.999999999999999e+299
    t722 = select(t721, t720, 0.0)
    t723 = t722 * t344
    t724 = t723 + t723
    t725 = t719 * t341
    t726 = t725 + t725
    t727 = t724 * kappa
    t728 = t342 < 1e+150
    t729 = select(t728, t727, 0.0)
    t730 = t286 > -1e+150
    t731 = select(t730, t729, 0.0)
    t732 = select(t338, 0.0, t726)
    t733 = t732 / t339
    t734 = t733 * t340
    t735 = -t734
    t736 = select(t338, 0.0, t735)
    t737 = t736 * t336
    t738 = -t737
    t739 = t733 * t337
    t740 = t738 + t739
    t741 = t711 * t334
    t742 = t711 * t326
    t743 = t742 * t332
    t744 = t742 * t329
    t745 = t331 * t331
    t746 = 1.0 + t745
    t747 = t744 / t746
    t748 = t747 * t293
    t749 = t747 * t330
    t750 = t740 + t749
    t751 = t748 * p.QCZ1
    t752 = t748 * t305
    t753 = t708 + t751
    t754 = t689 + t752
    t755 = t743 * 0.6366197723675814
    t756 = t755 * gamma
    t757 = t741 * t2
    t758 = t741 * t324
    t759 = t669 + t758
    t760 = t757 * t2
    t761 = t757 * p.QEZ3
    t762 = t759 + t761
    t763 = t741 * p.QEZ2
    t764 = t762 + t763
    t765 = t684 * t4
    t766 = t765 * p.LTR
    t767 = t765 * t319
    t768 = t766 * t318
    t769 = t766 * t313
    t770 = t769 * gamma
    t771 = t770 * gamma
    t772 = t768 * t312
    t773 = t768 * t310
    t774 = -t773
    t775 = t774 * dpi
    t776 = t772 * t309
    t777 = t772 * t307
    t778 = t777 * t2
    t779 = t777 * p.QDZ2
    t780 = t764 + t779
    t781 = t776 * fz
    t782 = t781 / p.FNOMIN
    t783 = t782 * t306
    t784 = -t783
    t785 = t659 + t782
    t786 = t549 + t784
    t787 = t753 / p.LMUY
    t788 = t787 * t305
    t789 = -t788
    t790 = t675 + t789
    t791 = t787 * p.LKY
    t792 = t787 * t303
    t793 = t678 + t792
    t794 = t791 * t302
    t795 = t791 * t298
    t796 = t795 * t91
    t797 = t795 * gamma
    t798 = t794 * t2
    t799 = t794 * t296
    t800 = t780 + t799
    t801 = t798 * t2
    t802 = t798 * p.QBZ3
    t803 = t800 + t802
    t804 = t794 * p.QBZ2
    t805 = t803 + t804
    t806 = t750 * gamma
    t807 = t806 * t2
    t808 = t806 * p.QHZ4
    t809 = t805 + t808
    t810 = t750 * t2
    t811 = t750 * p.QHZ2
    t812 = t809 + t811
    t813 = select(t128, 0.0, t731)
    t814 = t813 / t129
    t815 = t814 * t285
    t816 = -t815
    t817 = t682 + t816
    t818 = t551 * p.LVYKA
    t819 = t551 * t282
    t820 = t818 * t281
    t821 = t818 * t277
    t822 = t821 * t502
    t823 = t822 * t279
    t824 = t822 * p.RVY5
    t825 = t824 / t504
    t826 = t825 * kappa
    t827 = t820 * t276
    t828 = t820 * t271
    t829 = t828 / t275
    t830 = t829 * t276
    t831 = -t830
    t832 = 0.5 * t831
    t833 = t832 / t275
    t834 = select(t505, 0.0, t833)
    t835 = t834 * t272
    t836 = t835 + t835
    t837 = t836 * alpha
    t838 = t827 * t270
    t839 = t827 * t148
    t840 = t839 * gamma
    t841 = t839 * t2
    t842 = t839 * p.RVY2
    t843 = t812 + t842
    t844 = t551 * t265
    t845 = t551 * t182
    t846 = t537 + t844
    t847 = t534 + t845
    t848 = select(t262, 0.0, t847)
    t849 = t848 / t263
    t850 = t849 * t264
    t851 = -t850
    t852 = select(t262, 0.0, t851)
    t853 = t852 * t506
    t854 = -t853
    t855 = t854 * t259
    t856 = t854 * p.RCY1
    t857 = t856 / t508
    t858 = t857 * t256
    t859 = t857 * t237
    t860 = t859 / t510
    t861 = t857 * t254
    t862 = t857 * t244
    t863 = t860 + t862
    t864 = select(t511, t863, 0.0)
    t865 = select(t512, t864, 0.0)
    t866 = t865 * t239
    t867 = t865 * t234
    t868 = t849 * t513
    t869 = -t868
    t870 = t869 * t249
    t871 = t869 * p.RCY1
    t872 = t855 + t870
    t873 = t871 / t515
    t874 = t873 * t246
    t875 = t873 * t237
    t876 = t858 + t874
    t877 = t875 / t517
    t878 = t873 * t243
    t879 = t873 * t244
    t880 = t861 + t878
    t881 = t877 + t879
    t882 = -t880
    t883 = t876 + t882
    t884 = select(t518, t881, 0.0)
    t885 = select(t519, t884, 0.0)
    t886 = t885 * t240
    t887 = t885 * t234
    t888 = t866 + t886
    t889 = t867 + t887
    t890 = t889 * t2
    t891 = t889 * p.RHY2
    t892 = t843 + t891
    t893 = select(t520, t883, 0.0)
    t894 = t893 * t2
    t895 = t893 * p.REY2
    t896 = t892 + t895
    t897 = t888 * p.LYKA
    t898 = t888 * t233
    t899 = t897 * t232
    t900 = t897 * t226
    t901 = t900 / t231
    t902 = t901 * t232
    t903 = -t902
    t904 = 0.5 * t903
    t905 = t904 / t231
    t906 = select(t521, 0.0, t905)
    t907 = t906 * t228
    t908 = t907 + t907
    t909 = t908 * t227
    t910 = t908 * p.RBY2
    t911 = -t910
    t912 = t899 * gamma
    t913 = t912 * gamma
    t914 = t470 * t222
    t915 = t470 * t75
    t916 = select(t219, 0.0, t915)
    t917 = t916 / t220
    t918 = t917 * t221
    t919 = -t918
    t920 = select(t219, 0.0, t919)
    t921 = t920 * t476
    t922 = -t921
    t923 = t922 * t216
    t924 = t922 * p.RCX1
    t925 = t924 / t478
    t926 = t925 * t213
    t927 = t925 * t196
    t928 = t927 / t480
    t929 = t925 * t211
    t930 = t925 * t201
    t931 = t928 + t930
    t932 = select(t481, t931, 0.0)
    t933 = select(t482, t932, 0.0)
    t934 = t933 * p.RHX1
    t935 = t933 * t193
    t936 = t917 * t483
    t937 = -t936
    t938 = t937 * t206
    t939 = t937 * p.RCX1
    t940 = t923 + t938
    t941 = t939 / t485
    t942 = t941 * t203
    t943 = t941 * t196
    t944 = t926 + t942
    t945 = t943 / t487
    t946 = t941 * t200
    t947 = t941 * t201
    t948 = t929 + t946
    t949 = t945 + t947
    t950 = -t948
    t951 = t944 + t950
    t952 = select(t488, t949, 0.0)
    t953 = select(t489, t952, 0.0)
    t954 = t953 * t197
    t955 = t953 * t193
    t956 = t934 + t954
    t957 = t935 + t955
    t958 = select(t490, t951, 0.0)
    t959 = t958 * t2
    t960 = t958 * p.REX2
    t961 = t896 + t960
    t962 = t956 * p.LXAL
    t963 = t956 * t192
    t964 = t962 * t191
    t965 = t962 * t186
    t966 = t965 / t190
    t967 = t966 * t191
    t968 = -t967
    t969 = 0.5 * t968
    t970 = t969 / t190
    t971 = select(t491, 0.0, t970)
    t972 = t971 * t187
    t973 = t972 + t972
    t974 = t973 * kappa
    t975 = t964 * gamma
    t976 = t975 * gamma
    t977 = t671 * t147
    t978 = t671 * t168
    t979 = t586 + t978
    t980 = t680 + t846
    t981 = t846 * t180
    t982 = t846 * t148
    t983 = t838 + t981
    t984 = t982 * t522
    t985 = t984 * t178
    t986 = t984 * t147
    t987 = t979 + t985
    t988 = t986 / t524
    t989 = t988 * t175
    t990 = t988 * t169
    t991 = t990 / t526
    t992 = t988 * t172
    t993 = t988 * t173
    t994 = t991 + t993
    t995 = -t992
    t996 = t989 + t995
    t997 = select(t527, t994, 0.0)
    t998 = select(t528, t997, 0.0)
    t999 = t998 * t146
    t1000 = t998 * t168
    t1001 = t977 + t999
    t1002 = t643 + t1000
    t1003 = select(t529, t996, 0.0)
    t1004 = select(t165, 0.0, t1001)
    t1005 = t1004 / t166
    t1006 = t1005 * t167
    t1007 = -t1006
    t1008 = select(t165, 0.0, t1007)
    t1009 = t1008 * t148
    t1010 = t1008 * t147
    t1011 = t987 + t1009
    t1012 = t983 + t1010
    t1013 = t1003 * p.LEY
    t1014 = t1003 * t162
    t1015 = t589 + t1014
    t1016 = t1013 * t161
    t1017 = t1013 * t150
    t1018 = t590 + t1016
    t1019 = -t1017
    t1020 = t1019 * t159
    t1021 = t593 + t1020
    t1022 = t1020 * gamma
    t1023 = t1017 * gamma
    t1024 = t1023 * gamma
    t1025 = t1018 * t2
    t1026 = t1018 * p.PEY2
    t1027 = t961 + t1026
    t1028 = t1012 * fz
    t1029 = t1011 * p.LCY
    t1030 = t1011 * p.PCY1
    t1031 = t539 + t980
    t1032 = t1031 * p.LMUY
    t1033 = t1031 * t143
    t1034 = t790 + t1033
    t1035 = t1032 * p.LVY
    t1036 = t1032 * t142
    t1037 = t1035 * fz
    t1038 = t1037 * t2
    t1039 = t1037 * p.PVY2
    t1040 = t1027 + t1039
    t1041 = t576 + t1002
    t1042 = t1002 * gamma
    t1043 = t1041 * p.LHY
    t1044 = t1041 * t133
    t1045 = t1043 * t2
    t1046 = t1043 * p.PHY2
    t1047 = t1040 + t1046
    t1048 = select(t128, 0.0, t1002)
    t1049 = t1048 / t129
    t1050 = t1049 * t130
    t1051 = -t1050
    t1052 = t817 + t1051
    t1053 = select(t128, 0.0, t1052)
    t1054 = t1005 + t1053
    t1055 = -t1049
    t1056 = t980 + t1055
    t1057 = t1049 * gamma
    t1058 = t1057 * p.LKYC
    t1059 = t1057 * t124
    t1060 = t1058 * t123
    t1061 = t1058 * t121
    t1062 = t1061 * dpi
    t1063 = t1060 * fz
    t1064 = t1063 * t2
    t1065 = t1063 * p.PKY7
    t1066 = t1047 + t1065
    t1067 = t1028 * p.LMUY
    t1068 = t1028 * t117
    t1069 = t1034 + t1068
    t1070 = t1067 * t116
    t1071 = t1067 * t113
    t1072 = t595 + t1070
    t1073 = -t1071
    t1074 = t1073 * gamma
    t1075 = t1074 * gamma
    t1076 = t1072 * t112
    t1077 = t1072 * t107
    t1078 = t1077 * dpi
    t1079 = t1078 * dpi
    t1080 = t1076 * t2
    t1081 = t1076 * p.PDY2
    t1082 = t1066 + t1081
    t1083 = t1056 * p.LMUY
    t1084 = t1056 * t104
    t1085 = t1069 + t1084
    t1086 = t1083 * p.LKYC
    t1087 = t1083 * t103
    t1088 = t1059 + t1087
    t1089 = t1086 * gamma
    t1090 = t1089 * fz
    t1091 = t1090 * t2
    t1092 = t1090 * p.PVY4
    t1093 = t1082 + t1092
    t1094 = t1054 * p.LKY
    t1095 = t1054 * t98
    t1096 = t793 + t1095
    t1097 = t1094 * t97
    t1098 = t1094 * t94
    t1099 = t1098 * t530
    t1100 = t1099 * t95
    t1101 = t1099 * p.PKY4
    t1102 = t603 + t1100
    t1103 = t1101 / t532
    t1104 = t1097 * t93
    t1105 = t1097 * t90
    t1106 = t599 + t1104
    t1107 = -t1105
    t1108 = t1107 * t91
    t1109 = t1106 * t89
    t1110 = t1106 * t87
    t1111 = t1110 * dpi
    t1112 = t1109 * t0
    t1113 = t1109 * p.PKY1
    t1114 = select(t83, 0.0, t1103)
    t1115 = t1114 / t84
    t1116 = t1115 * t85
    t1117 = -t1116
    t1118 = t609 + t1115
    t1119 = select(t83, 0.0, t1117)
    t1120 = t1119 * t81
    t1121 = t1119 * t79
    t1122 = t614 + t1121
    t1123 = t1122 * dpi
    t1124 = t613 + t1120
    t1125 = t1120 * gamma
    t1126 = t1125 * gamma
    t1127 = t1118 / t0
    t1128 = t1127 * t76
    t1129 = -t1128
    t1130 = t1113 + t1129
    t1131 = t914 * t73
    t1132 = t914 * t43
    t1133 = t1132 * t492
    t1134 = t1133 * t71
    t1135 = t1133 * t42
    t1136 = t1135 / t494
    t1137 = t1136 * t68
    t1138 = t1136 * t62
    t1139 = t1138 / t496
    t1140 = t1136 * t65
    t1141 = t1136 * t66
    t1142 = t1139 + t1141
    t1143 = -t1140
    t1144 = t1137 + t1143
    t1145 = select(t497, t1142, 0.0)
    t1146 = select(t498, t1145, 0.0)
    t1147 = t1146 * t36
    t1148 = t1146 * t61
    t1149 = select(t499, t1144, 0.0)
    t1150 = select(t58, 0.0, t1147)
    t1151 = t1150 / t59
    t1152 = t1151 * t60
    t1153 = -t1152
    t1154 = t814 + t1151
    t1155 = select(t58, 0.0, t1153)
    t1156 = t1155 * t43
    t1157 = t1155 * t42
    t1158 = t1134 + t1156
    t1159 = t1131 + t1157
    t1160 = t1149 * p.LEX
    t1161 = t1149 * t55
    t1162 = t1160 * t54
    t1163 = t1160 * t48
    t1164 = -t1163
    t1165 = t1164 * t52
    t1166 = t1162 * t2
    t1167 = t1162 * t46
    t1168 = t1093 + t1167
    t1169 = t1166 * t2
    t1170 = t1166 * p.PEX3
    t1171 = t1168 + t1170
    t1172 = t1162 * p.PEX2
    t1173 = t1171 + t1172
    t1174 = t1159 * fz
    t1175 = t1158 * p.LCX
    t1176 = t1158 * p.PCX1
    t1177 = t914 * p.LMUX
    t1178 = t914 * t40
    t1179 = t1177 * p.LVX
    t1180 = t1177 * t39
    t1181 = t1179 * fz
    t1182 = t1181 * t2
    t1183 = t1181 * p.PVX2
    t1184 = t1173 + t1183
    t1185 = t1148 * p.LHX
    t1186 = t1148 * t34
    t1187 = t1185 * t2
    t1188 = t1185 * p.PHX2
    t1189 = t1184 + t1188
    t1190 = t1174 * p.LMUX
    t1191 = t1174 * t31
    t1192 = t1178 + t1191
    t1193 = t1190 * t30
    t1194 = t1190 * t27
    t1195 = -t1194
    t1196 = t1195 * gamma
    t1197 = t1196 * gamma
    t1198 = t1193 * t26
    t1199 = t1193 * t21
    t1200 = t1199 * dpi
    t1201 = t1200 * dpi
    t1202 = t1198 * t2
    t1203 = t1198 * p.PDX2
    t1204 = t1189 + t1203
    t1205 = t1154 * p.LKX
    t1206 = t1154 * t18
    t1207 = t1205 * t17
    t1208 = t1205 * t12
    t1209 = t1208 * dpi
    t1210 = t1209 * dpi
    t1211 = t1207 * t11
    t1212 = t1207 * t7
    t1213 = t1212 * t11
    t1214 = select(t500, t1213, 0.0)
    t1215 = select(t501, t1214, 0.0)
    t1216 = t1215 * t2
    t1217 = t1215 * p.PKX3
    t1218 = t1204 + t1217
    t1219 = t1211 * fz
    t1220 = t1219 * t2
    t1221 = t1219 * p.PKX2
    t1222 = t1218 + t1221
    t1223 = t1222 / t0
    t1224 = t1223 * t2
    t1225 = -t1224
    t1226 = t1130 + t1225
    t1227 = -t1223
    t1228 = t1226 + t1227
    t1229 = t1228 * p.LFZO
    t1230 = t1228 * p.FNOMIN
    t1231 = t786 + t1229
    return (
        t1231,
        t785,
        t1230,
        t1176,
        t1192,
        t1161,
        t1206,
        t1186,
        t1180,
        t1030,
        t1085,
        t1015,
        t1096,
        t1044,
        t1036,
        t767,
        t654,
        t963,
        t898,
        t819,
        t541,
        t1088,
        t651,
        t1175,
        t1198,
        t1202,
        t1197,
        t1162,
        t1166,
        t1169,
        t1165,
        t1219,
        t1220,
        t1216,
        t1185,
        t1187,
        t1181,
        t1182,
        t1029,
        t1076,
        t1080,
        t1075,
        t1018,
        t1025,
        t1021,
        t1022,
        t1112,
        t1124,
        t1108,
        t1043,
        t1045,
        t1037,
        t1038,
        t1090,
        t1091,
        t794,
        t798,
        t801,
        t797,
        t796,
        t676,
        t670,
        t754,
        t777,
        t778,
        t770,
        t771,
        t653,
        t655,
        t664,
        t667,
        t741,
        t757,
        t760,
        t755,
        t756,
        t750,
        t810,
        t806,
        t807,
        t964,
        t974,
        t940,
        t958,
        t959,
        t957,
        t899,
        t909,
        t911,
        t872,
        t893,
        t894,
        t889,
        t890,
        t839,
        t841,
        t840,
        t837,
        t823,
        t826,
        t542,
        t550,
        t544,
        t545,
        t1042,
        t1209,
        t1210,
        t1200,
        t1201,
        t1102,
        t1126,
        t1063,
        t1064,
        t1024,
        t1111,
        t1123,
        t1078,
        t1079,
        t1062,
        t660,
        t661,
        t775,
        t666,
        t976,
        t913,
        t536,
    )


def loop_mz(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of mz; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty(132 * BLOCK)
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
            w[130 * BLOCK + i] = g[124]
            w[131 * BLOCK + i] = g[125]
        for k in range(126):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + 6) * BLOCK + i]
