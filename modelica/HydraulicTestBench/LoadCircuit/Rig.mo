within HydraulicTestBench.LoadCircuit;
model Rig "The open test bench with the friction of thesis Table 6.2, for controllers outside of it"
  extends OpenTestBench(
    c=0,
    redeclare Effects.ShaftFriction shaftFriction(
      tau_c=bench.Tc, tau_s=bench.Ts, r=bench.r, omega_0=bench.w0));
  Interfaces.RealOutput pSupply(unit="Pa", nominal=1e7) "Supply pressure of the load circuit"
    annotation(Placement(transformation(extent={{100, -130}, {120, -110}})));
equation
  pSupply = supply.port.p;
  annotation(Documentation(info="<html>
<p>What a co-simulation with its own controllers takes: commands of pump and servo valve in; speed, pressures and angle
out. <code>alphaCMD_t</code> stays 0 under a sampled controller.</p>
<p><b>Source:</b> thesis Section 5.6, Table 6.2.</p>
<p><b>Valid, leaves out:</b> see <code>OpenTestBench</code>.</p>
</html>"));
end Rig;
