within HydraulicTestBench.Interfaces;
partial model PartialTorqueLoss "Slot for the torque a pump or motor loses"
  extends Icons.Slot;
  Flange_a flange "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  RealInput p_A(unit="Pa") "Pressure at port A"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}}, rotation=90, origin={-60, -120})));
  RealInput p_B(unit="Pa") "Pressure at port B"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}}, rotation=90, origin={60, -120})));
  Types.AngularVelocity w "Speed";
  Types.Torque tau "Torque lost, with the sign of w";
equation
  w = der(flange.phi);
  flange.tau = tau;
  annotation(Documentation(info="<html>
<p>Acts between the shaft and the housing. The law is one equation that gives tau from w and the pressures; with the
sign of w it takes energy, whichever way the machine runs. In the base model tau = 0.</p>
<p><b>Source:</b> this library; beside thesis Eq. 5.8 and 5.20, which have no loss.</p>
<p><b>Used by:</b> <code>torqueLoss</code> of <code>Pump.A4VSG</code> and <code>Hydraulics.VariableMotor</code>.</p>
</html>"));
end PartialTorqueLoss;
