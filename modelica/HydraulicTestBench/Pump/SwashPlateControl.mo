within HydraulicTestBench.Pump;
model SwashPlateControl "Swash plate control of the A4VSG pump: card, proportional valve, control cylinder"
  extends Icons.Component;

  // Numbers: `data` gives the start values, each parameter stays free to be set.
  constant Data.GreyBox data = Data.FreeGreyBox() "Identified parameter set";
  constant Data.StaticParameters known = Data.StaticParameters() "Known parameters";

  // Identified parameters, bounds of thesis Table 4.6
  parameter Types.NaturalFrequency omega_v(min=2*Constants.pi*18, max=2*Constants.pi*35) = data.omega_v
    "Natural frequency of the valve" annotation(Dialog(group="Identified"));
  parameter Types.DampingRatio zeta_v(min=0.3, max=2) = data.zeta_v "Damping ratio of the valve"
    annotation(Dialog(group="Identified"));
  parameter Types.Length L(min=30e-3, max=120e-3) = data.L "Stroke of the control piston"
    annotation(Dialog(group="Identified"));
  parameter Types.Area A_p(min=314.15e-6, max=5026.54e-6, nominal=1e-3) = data.A_p "Area of the control piston"
    annotation(Dialog(group="Identified"));
  parameter Types.Volume V_0(min=0.01e-3, max=0.5e-3) = data.V_0 "Dead volume of each chamber"
    annotation(Dialog(group="Identified"));
  parameter Types.Mass m_eff(min=20, max=700) = data.m_eff "Effective mass of piston and swash plate"
    annotation(Dialog(group="Identified"));
  parameter Types.SpringConstant k(min=0, max=30e3) = data.k "Spring constant of the control piston"
    annotation(Dialog(group="Identified"));
  parameter Types.DampingConstant b(min=0, max=30e3) = data.b "Damping of the control piston"
    annotation(Dialog(group="Identified"));
  parameter Types.ControllerGain K_p(min=0, max=100, nominal=10) = data.K_p "Gain of the outer controller, per rad"
    annotation(Dialog(group="Identified"));
  parameter Types.ControllerGain K_D(min=0.01, max=1) = data.K_D "Gain of the inner controller"
    annotation(Dialog(group="Identified"));
  parameter Types.Duration T_d(min=0.0035368, max=0.0159) = data.T_d "Derivative time of the inner controller"
    annotation(Dialog(group="Identified"));
  parameter Types.Area K_L(min=0.02e-6, max=5e-6, nominal=1e-7) = data.K_L "Opening of the leakage between the chambers"
    annotation(Dialog(group="Identified"));
  parameter Types.Duration tau(min=0, max=0.05) = data.tau "Dead time of card and sensors"
    annotation(Dialog(group="Identified"));

  // Known parameters: names of thesis Table 6, values of Table 5
  parameter Types.BulkModulus beta = known.beta "Oil stiffness" annotation(Dialog(group="Known"));
  parameter Types.Density rho = known.rho "Density of oil" annotation(Dialog(group="Known"));
  parameter Types.Angle alphaMAX(min=0.01) = known.alphaMAX "Largest swash plate angle"
    annotation(Dialog(group="Known"));
  parameter Types.Pressure pS = known.pS "Supply pressure" annotation(Dialog(group="Known"));
  parameter Types.Pressure pT = known.pT "Tank pressure" annotation(Dialog(group="Known"));
  parameter Types.Area k1 = known.k1 "Cubic coefficient of the valve opening" annotation(Dialog(group="Known"));
  parameter Types.Area k2 = known.k2 "Quadratic coefficient of the valve opening" annotation(Dialog(group="Known"));
  parameter Types.Area k3 = known.k3 "Linear coefficient of the valve opening" annotation(Dialog(group="Known"));
  parameter Types.Pressure p_start = known.pS/2 "Pressure in both chambers at the start"
    annotation(Dialog(group="Known"));
  parameter Real stroke_share(final unit="1", min=0.5, max=1) = 1 "Share of the stroke the end stops leave free"
    annotation(Dialog(group="Known"));
  parameter Types.Pressure dp_smooth(min=1) = 1e4 "Width of the orifice law around zero pressure difference"
    annotation(Dialog(tab="Numerics"));
  final parameter Types.Length a = L/(2*tan(alphaMAX)) "Distance of piston rod and swash plate axis, Eq. 3.8";
  final parameter Types.Length xpMAX = stroke_share*L/2 "Largest position of the control piston";
  final parameter Types.Length xpMIN = -stroke_share*L/2 "Smallest position of the control piston";

  Interfaces.RealInput alphaCMD(unit="%", min=-100, max=100, start=0, nominal=10) "Swash plate angle command"
    annotation(Placement(transformation(extent={{-240, 40}, {-200, 80}}),
      iconTransformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput alphaCMD_t(unit="%/s", start=0, nominal=100) "Rate of alphaCMD where known, else 0"
    annotation(Placement(transformation(extent={{-240, -20}, {-200, 20}}),
      iconTransformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput alphaPercent(unit="%", nominal=10) "Swash plate angle as fed back and logged"
    annotation(Placement(transformation(extent={{260, 50}, {280, 70}}),
      iconTransformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput u(unit="1", nominal=0.1) "Spool position"
    annotation(Placement(transformation(extent={{260, 10}, {280, 30}}),
      iconTransformation(extent={{100, -70}, {120, -50}})));

  // Slots, in the order of the signal path. What a slot needs to know stands twice: the modifier of the declaration
  // serves the default, that of the constraining class whatever is put in its place.
  replaceable CommandRateObserver commandRate constrainedby Interfaces.PartialCommandRate
    "Rate of the command"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-172, 48}, {-148, 72}})));
  replaceable Interfaces.Neutral.SignalWithRate angleError constrainedby Interfaces.PartialSignalWithRate
    "What the outer controller sees of the angle error"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-132, 8}, {-108, 32}})));
  replaceable Interfaces.Neutral.Signal cardOutput constrainedby Interfaces.PartialSignal
    "What becomes of the card's command at its output"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-52, 8}, {-28, 32}})));
  replaceable Interfaces.Neutral.Signal spoolCommand constrainedby Interfaces.PartialSignal
    "What becomes of the command on its way to the spool, ahead of the dead time"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-12, 8}, {12, 32}})));
  replaceable PadeDeadTime deadTime(tau=tau) constrainedby Interfaces.PartialDeadTime(tau=tau)
    "Dead time"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{28, 8}, {52, 32}})));
  replaceable SecondOrderSpool spool(omega_v=omega_v, zeta_v=zeta_v) constrainedby Interfaces.PartialSpool(
    omega_v=omega_v, zeta_v=zeta_v) "Dynamics of the spool"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{68, 8}, {92, 32}})));
  replaceable Interfaces.Neutral.Signal spoolOpening constrainedby Interfaces.PartialSignal
    "Opening of the edges from the spool position"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{108, 8}, {132, 32}})));
  replaceable Interfaces.Neutral.Supply supply(pS=pS) constrainedby Interfaces.PartialSupply(pS=pS)
    "Supply pressure"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-152, -52}, {-128, -28}})));
  replaceable Interfaces.Neutral.Compressibility oil constrainedby Interfaces.PartialCompressibility
    "What makes the oil softer"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-32, -102}, {-8, -78}})));
  replaceable Interfaces.Neutral.InternalLeakage internalLeakage constrainedby Interfaces.PartialTwoPort
    "Flow between the chambers beside Eq. 3.6"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{48, -102}, {72, -78}})));
  replaceable Interfaces.Neutral.ExternalLeakage externalLeakage constrainedby Interfaces.PartialExternalLeakage
    "Flow from the chambers to the tank"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{8, -162}, {32, -138}})));
  replaceable Interfaces.Neutral.PistonForce pistonForce constrainedby Interfaces.PartialPistonForce
    "Force on the piston beside Eq. 3.9"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{88, -52}, {112, -28}})));
  replaceable Interfaces.Neutral.SignalWithRate linkage constrainedby Interfaces.PartialSignalWithRate
    "Position of the swash plate's end of the linkage"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{128, -102}, {152, -78}})));
  replaceable Interfaces.Neutral.SignalWithRate angleSensor constrainedby Interfaces.PartialSignalWithRate
    "What the sensor makes of the angle"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{208, -102}, {232, -78}})));

  // Fixed parts
  ControllerCard card(final K_p=K_p, final K_D=K_D, final T_d=T_d) "Controller card"
    annotation(Placement(transformation(extent={{-92, 8}, {-68, 32}})));
  Hydraulics.ProportionalValve valve(
    final rho=rho, final k1=k1, final k2=k2, final k3=k3, final dp_smooth=dp_smooth) "Edges of the valve"
    annotation(Placement(transformation(extent={{-92, -102}, {-68, -78}})));
  Hydraulics.Tank tank(final p=pT) "Tank"
    annotation(Placement(transformation(extent={{-152, -152}, {-128, -128}})));
  Hydraulics.Chamber chamber1(final beta=beta, final p_start=p_start) "Chamber that grows with positive xp"
    annotation(Placement(transformation(extent={{-32, -52}, {-8, -28}})));
  Hydraulics.Chamber chamber2(final beta=beta, final p_start=p_start) "Chamber that shrinks with positive xp"
    annotation(Placement(transformation(extent={{-32, -152}, {-8, -128}})));
  Hydraulics.Orifice leakage(final K=K_L, final rho=rho, final dp_smooth=dp_smooth) "Leakage of Eq. 3.6"
    annotation(Placement(transformation(extent={{8, -102}, {32, -78}})));
  ControlPiston piston(
    final A_p=A_p, final V_0=V_0, final m_eff=m_eff, final k=k, final b=b,
    final xpMAX=xpMAX, final xpMIN=xpMIN) "Control piston"
    annotation(Placement(transformation(extent={{88, -102}, {112, -78}})));
  SwashPlateLinkage swashPlate(final a=a) "Swash plate"
    annotation(Placement(transformation(extent={{168, -102}, {192, -78}})));

  // Names of thesis Tables 7, 8 and 10
  Types.Angle alphaRef = alphaCMD/100*alphaMAX "Command in radians";
  Types.Angle alpha = swashPlate.alpha "Swash plate angle, Eq. 3.10";
  Types.AngularVelocity alpha_t = swashPlate.alpha_t "Angular velocity of the swash plate, Eq. 3.11";
  Types.AngularAcceleration alpha_tt = swashPlate.alpha_tt "Angular acceleration of the swash plate, Eq. 3.12";
  Types.SpoolPosition P_Cont = card.P_Cont "Output of the P controller, Eq. 3.18";
  Types.SpoolPosition u_Actual = spool.u "Spool position as the inner controller sees it";
  Types.SpoolPosition PD_Prop = card.PD_Prop "Proportional part of the PD controller, Eq. 3.17";
  Types.SpoolPosition PD_Der = card.PD_Der "Derivative part of the PD controller, Eq. 3.17";
  Types.SpoolPosition delay1 = deadTime.y "Output of the dead time, Eq. 3.20";
  Types.SpoolPosition uCMD = spool.u_ref "Command that reaches the spool";
  Types.SpoolVelocity u_t = spool.u_t "Spool velocity";
  Types.SpoolAcceleration u_tt = spool.u_tt "Spool acceleration, Eq. 3.19";
  Types.Area K = valve.K "Opening area of the valve, Eq. 3.3";
  Types.VolumeFlowRate Q1 = valve.Q1 "Flow into chamber 1, Eq. 3.1";
  Types.VolumeFlowRate Q2 = valve.Q2 "Flow out of chamber 2, Eq. 3.2";
  Types.VolumeFlowRate QL = leakage.q "Leakage from chamber 1 to chamber 2, Eq. 3.6";
  Types.Pressure p1 = chamber1.p "Pressure in chamber 1";
  Types.Pressure p2 = chamber2.p "Pressure in chamber 2";
  Real p1_t(final unit="Pa/s") = chamber1.p_t "Pressure gradient in chamber 1, Eq. 3.4";
  Real p2_t(final unit="Pa/s") = chamber2.p_t "Pressure gradient in chamber 2, Eq. 3.5";
  Types.Length xp = piston.x "Position of the control piston";
  Types.Velocity xp_t = piston.v "Velocity of the control piston";
  Types.Acceleration xp_tt = piston.x_tt "Acceleration of the control piston, Eq. 3.9";

equation
  // Command and feedback
  connect(alphaCMD, commandRate.s);
  connect(alphaCMD_t, commandRate.s_t);
  angleError.s = alphaRef - angleSensor.y;
  angleError.s_t = commandRate.rate/100*alphaMAX - angleSensor.y_t;
  alphaPercent = 100*angleSensor.y/alphaMAX;

  // Card, dead time and spool
  connect(angleError.y, card.e);
  connect(angleError.y_t, card.e_t);
  connect(spool.u, card.u);
  connect(spool.u_t, card.u_t);
  connect(card.y, cardOutput.s);
  connect(cardOutput.y, spoolCommand.s);
  connect(spoolCommand.y, deadTime.s);
  connect(deadTime.y, spool.u_ref);
  connect(spool.u, spoolOpening.s);
  connect(spoolOpening.y, valve.u);
  u = spool.u;

  // Hydraulic circuit, thesis Fig. 3.2
  connect(supply.port, valve.port_P);
  connect(tank.port, valve.port_T);
  connect(valve.port_A, chamber1.port);
  connect(valve.port_B, chamber2.port);
  connect(piston.port_1, chamber1.port);
  connect(piston.port_2, chamber2.port);
  connect(leakage.port_a, chamber1.port);
  connect(leakage.port_b, chamber2.port);
  connect(internalLeakage.port_a, chamber1.port);
  connect(internalLeakage.port_b, chamber2.port);
  connect(externalLeakage.port_1, chamber1.port);
  connect(externalLeakage.port_2, chamber2.port);
  connect(externalLeakage.port_T, tank.port);
  connect(piston.V_1, chamber1.V);
  connect(piston.V_2, chamber2.V);
  oil.p1 = chamber1.p;
  oil.p2 = chamber2.p;
  connect(oil.kappa1, chamber1.kappa);
  connect(oil.kappa2, chamber2.kappa);

  // Piston, linkage and sensor
  pistonForce.x = piston.x;
  pistonForce.v = piston.v;
  connect(pistonForce.f, piston.f);
  linkage.s = piston.x;
  linkage.s_t = piston.v;
  connect(linkage.y, swashPlate.x);
  connect(linkage.y_t, swashPlate.x_t);
  swashPlate.x_tt = piston.x_tt;
  connect(swashPlate.alpha, angleSensor.s);
  connect(swashPlate.alpha_t, angleSensor.s_t);
  annotation(
    Diagram(coordinateSystem(extent={{-200, -180}, {260, 100}})),
    Documentation(info="<html>
<p>From the command (percent of 15 degrees) to the swash plate angle and the spool position of the Bosch Rexroth A4VSG
71
pump on the thesis' bench: outer P and inner PD controller, dead time, second order valve spool, four edges, two
chambers,
piston with spring and damper, linkage. Nine states of the physics and the dead time, three of the command's rate.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.12 and 3.17 to 3.20, Fig. 3.2 to 3.4; parameters of Tables 4.6 and 5; names of
Tables 6, 7, 8 and 10 (Appendix F). <code>delay1</code> is there the name of a block; here it is that block's
output.</p>
<p><b>FMUs:</b> compile <code>FreeGreyBox</code> for Table 4.6 and <code>LockedGreyBox</code> for Table 4.5. They differ
in the start values of the 13 identified parameters alone, each of which can be set in the FMU.</p>
<p><b>Command rate:</b> the PD controller needs the rate of the command. Feed it to <code>alphaCMD_t</code> where it is
known. Where it is not it is 0, as an FMU's input that is left alone (in a model write so, or connect a
<code>Sources.Constant</code>), and <code>CommandRateObserver</code> estimates it.</p>
<p><b>Slots:</b> every <code>replaceable</code> part is a place where physics may be missing;
<code>Interfaces.Neutral</code>
fills it with nothing. <code>UsersGuide.Slots</code> lists them, <code>UsersGuide.AddAnEffect</code> shows how to put
an effect
in.</p>
<p><b>Start:</b> at rest in the middle, both chambers at p_start (half of pS; set both together).</p>
<p><b>Valid:</b> no load on the pump; amplitudes and frequencies of the tests it was fitted to (5 to 20 percent around
&plusmn;25 to &plusmn;75 percent, 0.1 to 30 Hz).</p>
<p><b>Leaves out:</b> what the slots are for; temperature; the effect of the pump's load on the swash plate.</p>
</html>"));
end SwashPlateControl;
