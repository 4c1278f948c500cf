within HydraulicTestBench.LoadCircuit;
model TestBench "The whole test bench with its controllers, thesis Appendix G"
  extends Icons.Component;
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Parameters of the bench";
  parameter Types.Torque Ts(min=0) = bench.Ts "Stiction" annotation(Dialog(group="Friction"));
  parameter Types.Torque Tc(min=0) = bench.Tc "Coulomb friction" annotation(Dialog(group="Friction"));
  parameter Real r(final unit="s/rad", min=0.1) = bench.r "Steepness at standstill"
    annotation(Dialog(group="Friction"));
  parameter Types.AngularVelocity w0(min=0.1) = bench.w0 "Speed over which stiction fades"
    annotation(Dialog(group="Friction"));
  parameter Real c(final unit="N.m.s/rad", min=0) = 0 "Linear friction beside it" annotation(Dialog(group="Friction"));
  parameter Types.MomentOfInertia Jeff(min=1e-3) = bench.Jeff "Inertia of both motors and the shaft";
  parameter Types.Volume Vm_max(min=1e-9) = bench.Vm_max "Displacement of a motor per revolution";
  parameter Real masterSpeed(final unit="1", min=0) = 1 "Master gain of the speed controller";
  parameter Real masterLoad(final unit="1", min=0) = 1 "Master gain of the load controller";
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

  // Parts 1, 2a, 2b and 5; their motors are PumpS and PumpL of Appendix G
  replaceable OpenTestBench rig(
    Jeff=Jeff, Vm_max=Vm_max, c=c,
    redeclare Effects.ShaftFriction shaftFriction(tau_c=Tc, tau_s=Ts, r=r, omega_0=w0))
    constrainedby OpenTestBench(Jeff=Jeff, Vm_max=Vm_max, c=c) "Circuits and shaft"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{20, -20}, {60, 20}})));
  SpeedController speed(
    final masterSpeed=masterSpeed, final alphaMAX=rig.alphaMAX,
    final feed=rig.Vm_max*rig.alphaMAX/(rig.V_d_max*rig.w_P)) "Part 3"
    annotation(Placement(transformation(extent={{-60, 40}, {-20, 80}})));
  LoadController load(final masterLoad=masterLoad, final feed=rig.Vm_max/(2*Constants.pi)/bench.K_qu) "Part 4"
    annotation(Placement(transformation(extent={{-60, -80}, {-20, -40}})));

  // Names of thesis Tables 11 to 14
  Types.Torque Tf = rig.shaftFriction.tau "Friction torque, Eq. 5.38";
  Types.AngularVelocity abs_omegaS = speed.abs_omegaS "Absolute value of the measured speed";
  Real ZeroSwitch(unit="1") = speed.ZeroSwitch "1 where the speed's PI controller is on";
  Types.Angle PI = speed.PI "Output of the speed's PI controller";
  Types.Angle alpha_feed = speed.alpha_feed "Feed forward of the angle, Eq. 5.35";
  Types.Angle Gest = rig.plate.alpha "Output of the swash plate's dynamics, Eq. 5.18";
  Types.Angle alpha = speed.alpha "Desired swash plate angle";
  Types.Percent NormalizeSignal = speed.NormalizeSignal "The same in percent";
  Real pI2(unit="1") = load.pI2 "Output of the load's PI controller";
  Real u_feed(unit="1") = load.u_feed "Feed forward of the spool, Eq. 5.37";
  Real limit1(unit="1") = load.limit1 "Command of the servo valve, limited";
  Real Negate(unit="1") = load.Negate "The same, negated";
  Types.Angle theta = rig.counter.theta "Position of the coupling";
  Types.Angle sum5 = rig.counter.sum5 "Rotation since the last pulse";
  Types.Angle absMe = rig.counter.absMe "Its absolute value";
  Types.Angle EventTheta = rig.counter.EventTheta "Position at the last pulse";
  Types.AngularVelocity contOmega = rig.counter.contOmega "True speed";
  Types.AngularVelocity EventOmega = rig.counter.EventOmega "True speed at the last pulse";
  Types.AngularVelocity discOmega = rig.counter.discOmega "Speed by the last two pulses, Eq. 5.1";
  Real EventTimer(unit="s") = rig.counter.EventTimer "Time of the last pulse";
  Real Timer(unit="s") = rig.counter.Timer "Time since the last pulse";
equation
  connect(omegaS_ref, speed.omegaS_ref);
  connect(rig.omegaS, speed.omegaS);
  connect(speed.NormalizeSignal, rig.alphaCMD);
  rig.alphaCMD_t = 0;
  connect(pL_ref, load.pL_ref);
  connect(omegaS_ref, load.omegaS_ref);
  connect(rig.pL, load.pL);
  connect(load.limit1, rig.u_ref);
  connect(rig.omegaS, omegaS);
  connect(rig.pS, pS);
  connect(rig.pL, pL);
  annotation(Documentation(info="<html>
<p>References of speed and load pressure in, speed by the pulses and both pressures out. The friction is that of Table
6.2, which includes all that c stands for in the linear models.</p>
<p>For another pump or more physics, write a class of the bench and use it here; its friction is then its own:
<code>model MyRig extends OpenTestBench(redeclare Pump.GreyBoxPlate plate, redeclare Effects.ShaftFriction
shaftFriction(tau_c=14.9, tau_s=54.8)); end MyRig;</code> and <code>extends TestBench(redeclare MyRig rig)</code>.</p>
<p>What is fed forward follows the displacements of motors and pump, the pump's speed and its largest angle as the bench
has them. The flow gain K<sub>qu</sub> of the servo valve stays that of Table 5.1.</p>
<p><b>Source:</b> thesis Fig. 5.13, Appendix G with the names of Tables 11 to 15. The table's Time is the simulation's
time; names of blocks are here those of their outputs.</p>
<p><b>Valid:</b> see <code>OpenTestBench</code>.</p>
<p><b>Leaves out:</b> sampling of the controllers, filters of the measured signals.</p>
</html>"));
end TestBench;
