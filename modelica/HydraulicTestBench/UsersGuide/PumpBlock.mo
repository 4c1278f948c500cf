within HydraulicTestBench.UsersGuide;
class PumpBlock "The pump as a block in a circuit of one's own"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p><code>Pump.A4VSG</code> has a shaft, ports A and B, a drain and the command. <code>Pump.A4VSGSignals</code> is the
same
with signals, to be compiled to an FMU.</p>
<pre>
model OnePump &quot;Pump at half its angle on a volume and a relief valve&quot;
  HydraulicTestBench.Mechanics.ConstantSpeed drive(w=1450*2*HydraulicTestBench.Constants.pi/60);
  HydraulicTestBench.Pump.A4VSG pump(redeclare HydraulicTestBench.Pump.MeanFlow pumpFlow);
  HydraulicTestBench.Hydraulics.Volume volume(V=1e-3, beta=1.4e9);
  HydraulicTestBench.Hydraulics.ReliefValve relief(
    p_set=200e5, dp_open=50e5, K_max=2e-5, rho=875, T_open=5e-3, zeta=1);
  HydraulicTestBench.Hydraulics.Tank tank;
equation
  pump.alphaCMD = 50;
  pump.alphaCMD_t = 0;
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, volume.port_a);
  connect(volume.port_b, relief.port_a);
  connect(relief.port_b, tank.port);
  connect(pump.port_B, tank.port);
  connect(pump.port_D, tank.port);
end OnePump;
</pre>
<table border=\"1\">
<tr><th>slot of A4VSG</th><th>partial class</th><th>takes</th></tr>
<tr><td>pumpFlow</td><td>PartialPumpFlow</td><td>MeanFlow, SimplifiedRippleFlow (default),
PistonKinematicsFlow</td></tr>
<tr><td>portLeakage</td><td>PartialTwoPort</td><td>Hydraulics.LaminarResistance, Effects.LeakageLaminar</td></tr>
<tr><td>drainLeakage</td><td>PartialExternalLeakage</td><td>Effects.LeakageExternal</td></tr>
<tr><td>torqueLoss</td><td>PartialTorqueLoss</td><td>Mechanics.MachineLoss</td></tr>
</table>
<p>The slots of <code>SwashPlateControl</code> (<code>Slots</code>) are slots of the block too.</p>
<p><b>Which flow?</b> <code>MeanFlow</code> unless the ripple is the question: it costs steps of a tenth of a
millisecond.
Behind a hose little of it is left (<code>Examples.RippleHose</code>), at a relief valve it may matter
(<code>Examples.RippleRelief</code>).</p>
<p><b>Volumes between parts.</b> Pump, motor, valves and orifices give a flow from pressures; <code>Volume</code>,
<code>Chamber</code> and the ends of a <code>Hose</code> give a pressure from flows. Put one of these between any two of
those, and no equation has to be iterated. Two volumes at one node share a pressure, and only one of them can say
what it is at the start: write <code>p(fixed=false)</code> at the other.</p>
<p><b>Source:</b> thesis Section 3.5 and Appendix F.</p>
</html>"));
end PumpBlock;
