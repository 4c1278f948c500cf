within HydraulicTestBench.Data;
record GreyBox "Identified parameters of the swash plate control, without values"
  extends Icons.Record;
  Types.NaturalFrequency omega_v "Natural frequency of the valve";
  Types.DampingRatio zeta_v "Damping ratio of the valve";
  Types.Length L "Stroke of the control piston";
  Types.Area A_p "Area of the control piston";
  Types.Volume V_0 "Dead volume of each chamber";
  Types.Mass m_eff "Effective mass of piston, swash plate and pump pistons";
  Types.SpringConstant k "Spring constant of the control piston";
  Types.DampingConstant b "Damping of the control piston";
  Types.ControllerGain K_p "Gain of the outer controller, spool command per rad";
  Types.ControllerGain K_D "Gain of the inner controller";
  Types.Duration T_d "Derivative time of the inner controller";
  Types.Area K_L "Opening of the leakage between the chambers";
  Types.Duration tau "Dead time of card and sensors";
  annotation(Documentation(info="<html>
<p>The thirteen unknowns the thesis fits to measurements. A set of numbers extends this record and gives every one of
them; <code>Pump.SwashPlateControl</code> takes its start values from such a set.</p>
<p><b>Source:</b> thesis Section 4.4.1, rows of Tables 4.5 and 4.6.</p>
</html>"));
end GreyBox;
