within HydraulicTestBench.UsersGuide;
class PumpModel "The pump's FMUs: inputs, outputs, parameters"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p><b>Classes.</b> <code>Pump.FreeGreyBox</code> is the pump of Table 4.6, <code>Pump.LockedGreyBox</code> that of
Table 4.5. <code>Pump.SwashPlateControl</code> is the same as <code>FreeGreyBox</code>.</p>
<table border=\"1\">
<tr><th>name</th><th>role</th><th>unit</th><th>meaning</th></tr>
<tr><td>alphaCMD</td><td>input</td><td>%</td><td>swash plate angle command, &plusmn;100 = &plusmn;15 degrees</td></tr>
<tr><td>alphaCMD_t</td><td>input</td><td>%/s</td><td>its rate, where known; else 0: see below</td></tr>
<tr><td>alphaPercent</td><td>output</td><td>%</td><td>swash plate angle as fed back and logged</td></tr>
<tr><td>u</td><td>output</td><td>1</td><td>spool position</td></tr>
<tr><td>omega_v ... tau</td><td>parameter</td><td>SI</td><td>the 13 identified parameters, each free to be set</td></tr>
<tr><td>beta ... k3, p_start, stroke_share</td><td>parameter</td><td>SI</td><td>known parameters and start</td></tr>
</table>
<p><b>States.</b> Spool position and velocity, piston position and velocity, two pressures; three of the dead time;
three of
the command's rate.</p>
<p><b>Command and rate.</b> With the exact rate on <code>alphaCMD_t</code> the PD controller is exact. Without it the
response
is off by at most 0.004 dB and 0.03 degrees up to 30 Hz. As an input of an FMU it can be left alone and is 0 then. In a
model nothing may be left open: write <code>pump.alphaCMD_t = 0</code>, or connect a <code>Sources.Constant</code>.</p>
<p><b>End stops.</b> <code>stroke_share</code> = 1 lets the piston use its whole stroke; the thesis' flow measurements
(Section 4.1) hint at 0.95. <code>xpMAX</code> and <code>xpMIN</code> follow from it.</p>
<p><b>Numerics.</b> <code>dp_smooth</code> is the width of the orifice law around zero pressure difference. At its
default of
0.1 bar it changes the response by less than 0.0001 dB and 0.0002 degrees; at 1 bar by 0.001 dB and 0.003 degrees.</p>
<p><b>Source:</b> thesis Appendix F for names and interface; figures from simulations of this library.</p>
</html>"));
end PumpModel;
