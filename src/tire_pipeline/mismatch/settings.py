"""Thresholds of the search, and how each was got.

Set on tuning cases of the project's rig simulator (those of spent proofs among them), on real recordings and
on reasoning, never on cases of the published proof.
"""

from __future__ import annotations

COEFFICIENT_SHARE = 0.0005
"""How far the model may be off along each direction of its coefficients, RMS over largest force."""

COEFFICIENT_PART = 0.05
COEFFICIENT_MOST = 0.0009
"""The same as a part of the flexible form's size, and at most: a worse fit is also worse along its
coefficients, but a fit is what leaves little along them."""

ONE_LOAD = 6.0
"""Factor on both in a recording at one load, for what keeps the mirror symmetry: a fit to many loads may be
off at any one of them."""

LOOSE = 60.0
LOOSE_SHARE = 0.009
"""Factor on what the coefficients may be off by, and least size of the flexible form, in the check that
effects with other drivers survive a refit."""

LOOSE_MEMORY = 0.5
"""How far friction may follow the power of the last seconds, in the same check: freely."""

MISFIT_SHARES = (0.001, 0.002, 0.004, 0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.05)
"""Sizes of the flexible form that are tried, over the largest force; the likeliest is taken."""

PATH_SHARES = (0.0002, 0.002, 0.005, 0.01, 0.02, 0.04)
"""Sizes of what a rising slip leaves otherwise than a falling one, over the largest force; the likeliest is
taken. Simulated tires leave next to nothing of it, the real ones of a flat-belt rig about 2%."""

FAST_SHARE = 1.0
"""How far the answer to load that changes faster than half a second is known: from nothing to twice the
steady force, and as much a quarter of a period late, where the relaxation length is of the order of the
wavelength."""

ASYMMETRY_SHARE = 0.12
"""What part of the misfit may break the tire's mirror symmetry (slip angle and camber turned over): a clean
tire breaks it by 0.1 to 0.2 of the misfit in the clean tuning cases."""

LEAST_GAIN = 8.0
"""Least improvement of the Bayes information criterion (log evidence, effective sample size) for an
effect."""

LEAST_GAIN_ALONE = 15.0
"""The same for an effect that is the only one: false ones have up to a log evidence of 14.4 in the tuning
cases and 10 in DART's other half."""

LEAST_LOOSE = LEAST_GAIN_ALONE
"""Least gain with coefficients nearly free, and friction free to follow the power of the last seconds, of an
effect that has another driver than the model's inputs: else the recording does not show that driver."""

LEAST_GAIN_LARGE = 10.0
LARGE_SHARE = 0.2
"""The same for an effect that is the only one and removes more than this share of the mismatch. In 400 tuning
cases where nothing is missing the false ones above a log evidence of 8 that remove a tenth are offsets and
load sensitivities, of which more is asked anyway; true weak ones remove 0.2 to 0.5."""

LEAST_GAIN_MORE = 15.0
"""The same for each effect of a set of two: false ones in the tuning cases have a log evidence of 11.5,
12.1 and 14.8, true ones that are not weak 15.8 and more."""

LEAST_GAIN_MANY = 40.0
"""The same for each effect of a set of three: what two forms get wrong may look like a third effect."""

SECOND_LAG = 0.05
"""Least evidence of a lag (relaxation, delay, low pass) beside another one, as a part of the other's."""

SECOND_SCALE = 30.0
SECOND_ALIKE = 60.0
"""Least gain of an effect that scales the force beside a stronger one, and of one that its form error looks
like (`errs_like`): false ones in the tuning cases have up to a log evidence of 24, but friction and a gain
beside
stiffness 44 and 56. Beside a shift it is a part of the shift's evidence, EXACT_SHARE squared: false ones have
0.19 to 0.43% of conicity's, a true one 1.8%."""

SECOND_SLOW = 60.0
"""Least gain of wear and of a change of surface beside a stronger temperature without its channel or one that
scales the force: false ones in the tuning cases have a log evidence of 36 and 57."""

KEPT = 12
"""Forms that the screen hands on to be fitted: a fixed number, because a straight line may promise too much
for one form (a delay beside a load that fluctuates) and must not bar the way of the others."""

TIE = 8.0
"""Log evidence within which two explanations are as good as each other."""

USUAL_FIRST = 4.0
"""Log evidence by which the simpler of two sets, or the more usual of two effects that look the same, may
be less likely."""

EQUAL = 1.5
"""Log evidence within which the more usual of two comes first, or the likelier one with frozen
coefficients. (The
latter likes a gain better than friction or combined slip, whose forms are a little wrong at small slip.)"""

PLAINLY_LESS = 0.6
LEAST_LESS = 0.1
LESS_LIKELY = 0.6
"""An explanation that leaves so much less of the mismatch, by this part of the noise's power at least, goes
first though another is likelier, if it has this part of the other's evidence."""

LEAST_SHARE = 0.02
"""Least share of the mismatch that an effect must remove (issue, item 5): refitted without it, or the others
as they stand."""

HELD_SHARE = 0.03
"""The same of an effect that is the only one, on sweeps that its fit has not seen. On the flat belt a wheel
that is out of round removes 1 to 2% (once 9%) where nothing is missing, a hidden camber 4 to 7%, a pressure
14 to 21%."""

SURE = 150.0
"""Log evidence from which that share is of the mismatch beside the other effects, not of all of it: an
effect of 0.9
of the noise beside one six times as strong removes less than a fiftieth of all. True ones that do so have 743
and more in the tuning cases, a compliance that is conicity's form error 94."""

LEVEL = 0.05
"""Level of the Wilcoxon test over sweeps, Holm-corrected."""

CALMER = 0.6
"""Noise is estimated again once effects are in, but taken only if it is smaller than this part of the first
estimate: a wheel that is not round trebles it, and what a poor form takes off is a fifth at most. Not asked
where such a wheel is in: at 0.8 of the noise it raises it by a quarter only, and gives it its colour, so that
the unexplained residual looked like a log evidence of 600."""

SHAPE_SHARE = 0.15
"""How wrong the form of an accepted effect may be, as a share of it, before a second one is believed."""

IMAGINED_SHARE = 0.6
"""The same where an effect's driver was not recorded and is simulated: friction power behind the best single
lag (5 s) explains 0.40 of the variance of calspan's recorded tread temperature (sweeps at 20 Hz)."""

EXACT_SHARE = 0.07
SHIFT_SHARE = 0.12
CAMBER_SHARE = 0.3
"""The same for an alternative that lags or shifts, by how right its own form is. 7% for lags and for an
offset of the angle or the force, of which only what they are recorded beside is not exact: in 440 spent
ambiguous cases and 200 further ones (100 relaxations, 60 offsets of the angle, 40 filters) no true one was
put second by more than this and a log evidence of 8. 12% for conicity and an offset of camber; 30% where
one of the two is
an offset of camber and camber does not vary, so that nothing shows how right the model's answer to it is."""

USUAL_MISFIT = 0.01
"""What a formula fitted to a clean tire leaves at most, RMS over largest force: the tuning tires 0.4 to 0.9%,
calspan 2%, DART 3%. The three shares above are for such formulas."""

MOST_EFFECTS = 3
"""How many effects are put in at most."""

AMBIGUITY_SHARE = 0.04
AMBIGUITY_LOG_EVIDENCE = 5.0
AMBIGUITY_LOST = 0.5
"""Another effect is an alternative if so little of what the named one does is out of its reach, or if that is
worth so little log evidence, and if its own fit loses less than this part of what it should lose, or TIE.
A lag beside a
lag and a shift beside a shift, whose form error is known, may lose this much log evidence: in 160
ambiguous tuning cases the true one, where it was not named first, lost 3.6 at most, form errors aside."""

ODDS = 3.0
"""And in any case if it is less likely by no more log evidence than this, 20 to 1: LEVEL. A temperature was
excluded at 2.9, a wear though it was likelier than the change of surface that was named."""

REMAINDER_LIMIT = 1.3
REMAINDER_LOG_EVIDENCE = 60.0
"""What is left is called unexplained if its power at some scale is so much above white noise, and if
that is worth so much log evidence; or if it is larger than the next share of the largest force, which is
more than a fitted formula's own misfit."""

REMAINDER_SHARE = 0.025

UNNAMED_PART = 0.3
UNNAMED_LEAST = 30.0
UNNAMED_OF_ALL = 0.015
"""A name is withdrawn if an unnamed form is as likely in its place (by TIE), or adds on top of all
named effects more than UNNAMED_PART of the effect's own evidence, UNNAMED_LEAST, and UNNAMED_OF_ALL of
the strongest effect's evidence (a strong effect's form is never right to the last per cent).
On the tuning cases true effects were met by 0 to 0.3 of their evidence, false names by 0.3 to 30 times."""

OTHER_START = 0.15
"""An effect is tried first, where the likeliest one led to nothing, if the screen gives it this part of the
likeliest one's evidence."""

TURNS = 30.0
"""Log evidence that a rate must have more if it may be small where a slip turns, at its largest, where the
misfit is,
too: beside true names in a hundred tuning cases it had up to 32, beside a gain that stood for a friction that
follows the rate 91 to 778 in 15 of 17."""

UNLIKE = 0.2
"""If what is left is worth more than this part of the evidence for the named effects, they only resemble the
cause, and nothing is named (backlash must not become a delay)."""
