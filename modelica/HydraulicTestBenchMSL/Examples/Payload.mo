within HydraulicTestBenchMSL.Examples;
model Payload "Drum and wire of this library between a shaft and a mass of the standard library"
  extends Modelica.Icons.Example;
  Modelica.Mechanics.Rotational.Sources.ConstantSpeed winch(w_fixed=2) "Hoists at 0.4 m/s";
  HydraulicTestBench.Mechanics.Drum drum(r_d=0.2) "Drum";
  HydraulicTestBench.Mechanics.Wire wire(k_w=1e5, d_w=2e3, l_0=10) "Wire, slack by 0.1 m at the start";
  Modelica.Mechanics.Translational.Components.Mass load(m=500, s(start=-9.9, fixed=true), v(start=0, fixed=true))
    "Mass";
  Modelica.Mechanics.Translational.Sources.ConstantForce weight(f_constant=-4905) "Its weight";
equation
  connect(winch.flange, drum.shaft);
  connect(drum.wire, wire.flange_a);
  connect(wire.flange_b, load.flange_a);
  connect(weight.flange, load.flange_b);
  annotation(
    experiment(StartTime=0, StopTime=5, Interval=0.001, Tolerance=1e-8),
    Documentation(info="<html>
<p>The mass falls until the wire is taut, swings, and is then hoisted at the drum's speed with its weight in the
wire.</p>
<p><b>Source:</b> thesis Section 5.7.</p>
</html>"));
end Payload;
