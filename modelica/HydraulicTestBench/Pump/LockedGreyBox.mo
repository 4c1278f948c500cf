within HydraulicTestBench.Pump;
model LockedGreyBox "Swash plate control with the locked parameter set, thesis Table 4.5"
  extends SwashPlateControl(data=Data.LockedGreyBox());
  annotation(Documentation(info="<html>
<p>The pump with stroke and piston area of the data sheet; the FMU of the <i>locked</i> set.</p>
<p><b>Source:</b> thesis Table 4.5, in <code>Data.LockedGreyBox</code>.</p>
<p><b>Valid:</b> up to about 95 percent of the stroke, where the volume of a chamber falls to its floor.</p>
<p><b>Leaves out:</b> see <code>SwashPlateControl</code>.</p>
</html>"));
end LockedGreyBox;
