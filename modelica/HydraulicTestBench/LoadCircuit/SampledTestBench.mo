within HydraulicTestBench.LoadCircuit;
model SampledTestBench "The whole test bench under its sampled controllers"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time of both controllers";
  Interfaces.RealInput omegaS_ref(unit="rad/s", start=0, nominal=10) "Reference of the speed"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput pL_ref(unit="Pa", start=0, nominal=1e6) "Reference of the load pressure"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput omegaS(unit="rad/s", nominal=10) "Speed as the pulses tell it"
    annotation(Placement(transformation(extent={{100, 70}, {120, 90}})));
  Interfaces.RealOutput pS(unit="Pa", nominal=1e6) "Pressure across the supply motor"
    annotation(Placement(transformation(extent={{100, 10}, {120, 30}})));
  Interfaces.RealOutput pL(unit="Pa", nominal=1e6) "Pressure across the load motor"
    annotation(Placement(transformation(extent={{100, -50}, {120, -30}})));
  Rig rig "Circuits and shaft"
    annotation(Placement(transformation(extent={{20, -20}, {60, 20}})));
  Controllers.SpeedController speed(
    dt=dt, final largest=rig.alphaMAX, final feed=rig.Vm_max*rig.alphaMAX/(rig.V_d_max*rig.w_P)) "Speed controller"
    annotation(Placement(transformation(extent={{-60, 40}, {-20, 80}})));
  Controllers.LoadController load(dt=dt, final feed=rig.Vm_max/(2*Constants.pi)/rig.bench.K_qu) "Load controller"
    annotation(Placement(transformation(extent={{-60, -80}, {-20, -40}})));
equation
  connect(omegaS_ref, speed.reference);
  connect(rig.omegaS, speed.measured);
  connect(speed.alphaCMD, rig.alphaCMD);
  rig.alphaCMD_t = 0;
  connect(pL_ref, load.reference);
  connect(rig.pL, load.measured);
  connect(omegaS_ref, load.speed);
  connect(load.u_ref, rig.u_ref);
  connect(rig.omegaS, omegaS);
  connect(rig.pS, pS);
  connect(rig.pL, pL);
  annotation(Documentation(info="<html>
<p>What a co-simulation of <code>Rig</code> with the same controllers in Python has to come to.</p>
<p><b>Source:</b> thesis Sections 5.4 and 5.6.</p>
<p><b>Valid, leaves out:</b> see <code>OpenTestBench</code> and <code>Controllers</code>.</p>
</html>"));
end SampledTestBench;
