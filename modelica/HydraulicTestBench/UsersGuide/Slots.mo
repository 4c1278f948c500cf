within HydraulicTestBench.UsersGuide;
class Slots "The slots of the models, and what each can take"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>A slot is a replaceable part of <code>Pump.SwashPlateControl</code>. Its partial class in <code>Interfaces</code>
owns
connectors and signs; the number of equations its filling has to give is in the last column. The base model's filling is
in <code>Interfaces.Neutral</code> (nothing) or, where the thesis has a law, in <code>Pump</code>.</p>
<table border=\"1\">
<tr><th>slot</th><th>partial class</th><th>sees -&gt; gives</th><th>takes, for example</th><th>equations</th></tr>
<tr><td>commandRate</td><td>PartialCommandRate</td><td>command, its told rate -&gt; rate</td><td>CommandRateInput:
only what
is told</td><td>1</td></tr>
<tr><td>angleError</td><td>PartialSignalWithRate</td><td>angle error (rad) and its rate -&gt; the same</td><td>dead
zone of
the outer controller: y = f(s), y_t = f'(s) s_t</td><td>2</td></tr>
<tr><td>cardOutput</td><td>PartialSignal</td><td>sum of PD_Prop and PD_Der -&gt; command</td><td>sample and hold of the
card: <code>when sample(0, T_s) then y = s;</code></td><td>1</td></tr>
<tr><td>spoolCommand</td><td>PartialSignal</td><td>command -&gt; command ahead of the dead time</td><td>hysteresis:
play with
y as a state; the card's loop sees the true spool all the same</td><td>1</td></tr>
<tr><td>deadTime</td><td>PartialDeadTime (tau)</td><td>command -&gt; delayed command</td><td>TransportDelay</td>
<td>1</td></tr>
<tr><td>spool</td><td>PartialSpool (omega_v, zeta_v)</td><td>u_ref -&gt; u, u_t, u_tt</td><td>stops of the spool,
limited
spool speed: the filling owns the states and can hold them, so nothing winds up</td><td>3</td></tr>
<tr><td>spoolOpening</td><td>PartialSignal</td><td>u -&gt; opening the edges see</td><td>overlap (dead band), offset
of the
zero; the spool sensor sees u as it is</td><td>1</td></tr>
<tr><td>supply</td><td>PartialSupply (pS)</td><td>signed flow Q through the open P edge -&gt; loss dp</td><td>droop:
<code>T*der(dp) = R*Q - dp</code></td><td>1</td></tr>
<tr><td>oil</td><td>PartialCompressibility</td><td>p1, p2 -&gt; kappa1, kappa2</td><td>entrained air: kappa of the
absolute
pressure of each chamber; 1/beta_eff = 1/beta + kappa</td><td>2</td></tr>
<tr><td>internalLeakage</td><td>PartialTwoPort</td><td>dp = p1 - p2 -&gt; q</td><td>laminar leakage: q = C dp</td>
<td>1</td></tr>
<tr><td>externalLeakage</td><td>PartialExternalLeakage</td><td>p1, p2 above tank -&gt; q1, q2</td><td>leakage of both
chambers to the tank: q = C p</td><td>2</td></tr>
<tr><td>pistonForce</td><td>PartialPistonForce</td><td>x, v -&gt; f</td><td>friction, hardening spring, preload,
constant
force</td><td>1</td></tr>
<tr><td>linkage</td><td>PartialSignalWithRate</td><td>position of the piston (m) and its velocity -&gt; position that
moves
the plate and its velocity</td><td>play with y as a state</td><td>2</td></tr>
<tr><td>angleSensor</td><td>PartialSignalWithRate</td><td>swash plate angle (rad) and its rate -&gt; angle that is fed
back and
logged</td><td>lag: <code>der(y) = y_t; y_t = (s - y)/T_f</code></td><td>2</td></tr>
</table>
<p><b>Slots elsewhere.</b> The pump block adds four (<code>PumpBlock</code>). <code>Hydraulics.Volume</code> and
<code>Hose</code> have <code>fluid</code> (PartialFluid: p -&gt; beta_eff, 1 equation; <code>Hydraulics.Fluids</code>),
<code>Hydraulics.VariableMotor</code> its losses. The test bench <code>LoadCircuit.OpenTestBench</code> has
<code>plate</code> (PartialSwashPlate, 3), <code>pumpFlow</code> (PartialPumpFlow, 3), <code>servoOpening</code>
(PartialSignal, 1), <code>shaftFriction</code> (PartialShaftFriction: w -&gt; tau, 1), <code>motorLeakage</code>
(PartialMotorLeakage: p_s, p_L -&gt; q_s, q_L, 2), <code>motorLoss</code> (PartialMotorLoss: T_s, T_L and speeds -&gt;
tau_s, tau_L, 2), <code>coupling</code> (PartialCoupling: phi_rel and tau, 1) and <code>hoses</code> (PartialHoses: four
flows, 4); the last six are places where physics may be missing, and <code>Effects</code> has a class for each.
</p>
<p>The angle follows the linkage: <code>alpha</code> is computed from what <code>linkage</code> gives, so the swash
plate and
its sensor stand behind a play, and the piston, its force balance and its oil ahead of it. <code>alpha_tt</code> (Eq.
3.12)
uses the piston's acceleration and holds for a linkage without play.</p>
<p>Where a slot gives a rate beside a value, the rate has to be the derivative of the value: the PD controller works on
it, and nothing else would notice.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20 for what the base model has; this library for the places.</p>
</html>"));
end Slots;
