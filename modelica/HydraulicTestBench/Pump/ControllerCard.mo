within HydraulicTestBench.Pump;
block ControllerCard "Outer P and inner PD controller, thesis Eq. 3.17 and 3.18"
  extends Icons.Component;
  parameter Types.ControllerGain K_p "Gain of the outer controller, spool command per rad";
  parameter Types.ControllerGain K_D "Gain of the inner controller";
  parameter Types.Duration T_d "Derivative time of the inner controller";
  Interfaces.RealInput e(unit="rad") "Angle error"
    annotation(Placement(transformation(extent={{-140, 55}, {-100, 95}})));
  Interfaces.RealInput e_t(unit="rad/s") "Rate of the angle error"
    annotation(Placement(transformation(extent={{-140, 5}, {-100, 45}})));
  Interfaces.RealInput u(unit="1") "Spool position from its sensor"
    annotation(Placement(transformation(extent={{-140, -45}, {-100, -5}})));
  Interfaces.RealInput u_t(unit="1/s") "Spool velocity"
    annotation(Placement(transformation(extent={{-140, -95}, {-100, -55}})));
  Interfaces.RealOutput y(unit="1") "Spool command, ahead of the dead time"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Types.SpoolPosition P_Cont "Output of the outer controller";
  Types.SpoolPosition PD_Prop "Proportional part of the inner controller";
  Types.SpoolPosition PD_Der "Derivative part of the inner controller";
equation
  P_Cont = K_p*e;
  PD_Prop = K_D*(P_Cont - u);
  PD_Der = K_D*T_d*(K_p*e_t - u_t);
  y = PD_Prop + PD_Der;
  annotation(Documentation(info="<html>
<p>The outer loop asks for a spool position in proportion to the angle error, the inner loop drives the spool there.
No signal is differentiated: the rates of angle and spool are states or follow from them.</p>
<p><b>Source:</b> thesis Eq. 3.17 (K_D T_d s + K_D), 3.18, Fig. 3.4; the loop gives Eq. 3.20. The angle error is in
rad.</p>
<p><b>Valid:</b> a card that samples much faster than its loop; its delay is in the dead time.</p>
<p><b>Leaves out:</b> sampling, resolution and limits of the card.</p>
</html>"));
end ControllerCard;
